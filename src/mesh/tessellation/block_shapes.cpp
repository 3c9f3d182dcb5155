#include "mesh/tessellation/block_shapes.h"

#include <algorithm>

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;

namespace {

// Places along one side of a block, no farther than `end`.
std::vector<int> places_along(int cells, int level, std::int64_t end) {
  std::vector<int> places;
  for (int k = 0; k <= cells; ++k)
    places.push_back(static_cast<int>(std::min(std::int64_t{k} << level, end)));
  return places;
}

}  // namespace

std::optional<BlockPlaces> places_of_shape(const PatchLayout& layout, int level, int block_cells,
                                           std::size_t shape) {
  const std::int64_t full = std::int64_t{block_cells} << level;
  const auto end_along = [&](int samples, bool is_cut) {
    const std::int64_t cells = samples - 1;
    return is_cut ? cells % full : cells < full ? 0 : full;
  };
  const std::int64_t across = end_along(layout.columns, (shape & 1u) != 0),
                     up = end_along(layout.rows, (shape & 2u) != 0);
  if (across == 0 || up == 0) return std::nullopt;
  return BlockPlaces{places_along(block_cells, level, across),
                     places_along(block_cells, level, up)};
}

std::optional<std::size_t> shape_of(const PatchLayout& layout, const PatchPlace& patch,
                                    int block_cells, int i, int j) {
  const int across = layout.sample_column(patch, (i + 1) * block_cells) -
                     layout.sample_column(patch, i * block_cells),
            up = layout.sample_row(patch, (j + 1) * block_cells) -
                 layout.sample_row(patch, j * block_cells);
  if (across == 0 || up == 0) return std::nullopt;
  const std::int64_t full = std::int64_t{block_cells} << patch.level;
  return (across < full ? 1u : 0u) | (up < full ? 2u : 0u);
}

BlockPlaces even_places(int block_cells) {
  return {places_along(block_cells, 0, block_cells), places_along(block_cells, 0, block_cells)};
}

}  // namespace plumb::mesh::tessellation
