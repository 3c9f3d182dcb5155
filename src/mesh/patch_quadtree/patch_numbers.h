// The whole numbers of one patch, as they are coded.
#pragma once

#include <cstdint>

#include "core/grid.h"
#include "mesh/patch_quadtree/patch_layout.h"
#include "mesh/patch_quadtree/quantiser.h"
#include "terrain/height_grid.h"

namespace plumb::mesh::patch_quadtree {

/// (n + 3) x (n + 3) numbers, sample (i, j) of the patch at (i + 1, j + 1); voids hold 1 where
/// there is no height, and are empty where every sample has one. The number of a void says nothing.
struct PatchNumbers {
  Grid<std::int32_t> q;
  Grid<std::uint8_t> voids;

  bool has_voids() const { return !voids.empty(); }
};

/// What the quantiser makes of a patch's heights.
PatchNumbers numbers_of(const terrain::HeightGrid& heights_m, const PatchLayout& layout,
                        const PatchPlace& patch, const Quantiser& quantiser);

/// Heights again, NaN for a void.
Grid<float> heights_of(const PatchNumbers& numbers, const Quantiser& quantiser, int level);

}  // namespace plumb::mesh::patch_quadtree
