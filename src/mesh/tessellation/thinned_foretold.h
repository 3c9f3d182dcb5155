// What thinning a patch's blocks costs against the patch itself: from which bounds are foretold.
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.h"
#include "mesh/patch_quadtree/patch_layout.h"
#include "mesh/tessellation/block_pieces.h"
#include "mesh/tessellation/mixture_deviation.h"

namespace plumb::mesh::tessellation {

/// Of a block, by thinning: the largest distance of any mixture that a bound of that thinning is
/// for from the block in full detail, both on the patch's own heights, as if its samples stood
/// evenly.
/// Part of the file's format: what is coded is how bounds differ from it.
class ThinnedForetold {
 public:
  explicit ThinnedForetold(const BlockPieces& pieces);

  /// Of every block, row by row: `levels` distances in metres, the first zero; -1 for all of a
  /// block that has a void or lies beyond the terrain. heights_m: (n + 3)^2 of the patch, as
  /// decoded.
  std::vector<double> distances_m(const patch_quadtree::PatchLayout& layout,
                                  const patch_quadtree::PatchPlace& patch,
                                  const Grid<float>& heights_m) const;

 private:
  int cells_, coarsest_;
  MixtureDeviation block_;
};

}  // namespace plumb::mesh::tessellation
