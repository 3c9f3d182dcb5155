// Vertical walls below the rims of patches, where the patch beyond may be drawn otherwise.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/tessellation/block_levels.h"
#include "mesh/tessellation/patch_mesh.h"

namespace plumb::mesh::tessellation {

/// A piece of a skirt: it hangs from a block's side as drawn.
struct Skirt {
  std::vector<PatchPoint> top;  // the side's vertices, so that outside lies to the right
  double depth_m = 0.0;
};

/// The published variant's skirts of one drawn patch: one below every side of a block across which
/// another patch lies, as deep as the two bounds together, nor more than the two patches' heights
/// span.
/// Source: [Yusov & Shevtsov 2011, section 5]: "such that it hides all possible cracks".
std::vector<Skirt> skirts_of(const Prepared& prepared, const PatchSelection& selection,
                             const ChosenLevels& levels, std::size_t drawn);

}  // namespace plumb::mesh::tessellation
