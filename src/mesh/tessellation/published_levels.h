// The paper's choice of tessellation factors within one patch.
#pragma once

#include "mesh/tessellation/block_levels.h"

namespace plumb::mesh::tessellation {

/// Factors of a patch's blocks by projected lengths at the middles of their sides.
///
/// bound_m is what the paper claims of a block: lambda^(d) of its inside's d, and Err(P); only
/// where `inner-minimum` is mended, what lies between the pieces as drawn and the patch's full
/// detail, and Err(P).
///
///   (1) A side that is all void is thinned most and has no say in the insides beside it. (2) No
///   thinning is chosen that moves a void's outline under one factor (under `mixed-factors` mended:
///   under any that is drawn).
/// Source: [Yusov & Shevtsov 2011, section 5, "Fine-Grain Level of Detail Selection"], which knows
/// no voids.
PatchLevels published_levels(const Prepared& prepared, const ViewTest& view,
                             const patch_quadtree::PatchPlace& patch, const Grid<float>& heights_m,
                             LevelCounts& counts);

}  // namespace plumb::mesh::tessellation
