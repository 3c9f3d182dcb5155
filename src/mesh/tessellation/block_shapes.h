// The few shapes that blocks of a level have: whole, or cut off by the terrain's edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/patch_quadtree/patch_layout.h"

namespace plumb::mesh::tessellation {

/// Where the samples of a block stand: block_cells + 1 columns from its western side on, as many
/// rows from its southern; never falling. Places beyond the terrain are its last.
struct BlockPlaces {
  std::vector<int> column, row;

  friend bool operator==(const BlockPlaces&, const BlockPlaces&) = default;
};

/// Bit 0: narrower, cut off by the terrain's eastern edge; bit 1: lower, by its northern.
inline constexpr std::size_t kBlockShapes = 4;

/// Places of the blocks of a shape, relative to their corner; nothing where a level has no such
/// block.
std::optional<BlockPlaces> places_of_shape(const patch_quadtree::PatchLayout& layout, int level,
                                           int block_cells, std::size_t shape);

/// The shape of block i of row j of a patch; nothing if it lies beyond the terrain.
std::optional<std::size_t> shape_of(const patch_quadtree::PatchLayout& layout,
                                    const patch_quadtree::PatchPlace& patch, int block_cells, int i,
                                    int j);

/// Places of a block whose samples stand evenly, one apart.
BlockPlaces even_places(int block_cells);

}  // namespace plumb::mesh::tessellation
