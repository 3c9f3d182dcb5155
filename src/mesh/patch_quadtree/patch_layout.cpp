#include "mesh/patch_quadtree/patch_layout.h"

#include <bit>

#include "core/check.h"

namespace plumb::mesh::patch_quadtree {

std::int64_t PatchLayout::first_of_level(int level) const {
  std::int64_t count = 0;
  for (int above = levels - 1; above > level; --above)
    count += static_cast<std::int64_t>(patch_columns(above)) * patch_rows(above);
  return count;
}

PatchPlace PatchLayout::place(std::int64_t index) const {
  require(index >= 0 && index < patch_count(), "a patch's number must be in [0, {}), got {}",
          patch_count(), index);
  int level = levels - 1;
  while (index >= first_of_level(level - 1)) --level;
  const std::int64_t within = index - first_of_level(level);
  return {level, static_cast<int>(within % patch_columns(level)),
          static_cast<int>(within / patch_columns(level))};
}

PatchLayout layout_of(int columns, int rows, int patch_cells) {
  require(columns >= 2 && rows >= 2, "a terrain of patches needs 2 x 2 samples, got {} x {}",
          columns, rows);
  require(patch_cells >= 8 && patch_cells <= 1024 &&
              std::has_single_bit(static_cast<unsigned>(patch_cells)),
          "patch_cells must be a power of two from 8 to 1024, got {}", patch_cells);
  PatchLayout layout{columns, rows, patch_cells, 1};
  while (layout.patch_columns(layout.levels - 1) > 1 || layout.patch_rows(layout.levels - 1) > 1)
    ++layout.levels;
  return layout;
}

}  // namespace plumb::mesh::patch_quadtree
