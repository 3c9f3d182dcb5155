// The paper's error of patches, and of blocks, as it is printed.
#pragma once

#include <vector>

#include "core/grid.h"
#include "mesh/patch_quadtree/patch_layout.h"

namespace plumb::mesh::tessellation {

/// Err_appr of every patch by its number, metres: of the finest level zero, of the others the
/// largest vertical distance of its bilinearly interpolated samples from its children's, more than
/// the largest Err_appr of these. Samples that are voids, or interpolated from one, say nothing.
/// Interpolation is by where samples stand: at the terrain's edge a patch's last cell is narrower.
/// Source: [Yusov & Shevtsov 2011, section 5, "Patch error"]; the children of (m, n) are
/// (2m + s, 2n + t), s and t 0 or 1.
std::vector<float> published_errors(const Grid<float>& heights_m,
                                    const patch_quadtree::PatchLayout& layout);

}  // namespace plumb::mesh::tessellation
