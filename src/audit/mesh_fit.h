// What is wrong with the place of a stranger's mesh before any error of it means something.
#pragma once

#include <optional>

#include "audit/depth_fit.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/claim.h"
#include "core/triangle_mesh.h"
#include "terrain/mesh_file.h"

namespace plumb::audit {

/// Compares a mesh's vertices, as `options` placed them, with the terrain above or below them; and,
/// unless they are the terrain's, with the terrain under every other placing that is known to
/// happen: each of the 48 ways to name or turn the axes, another unit, an offset forgotten, given
/// twice, or that puts a corner or the middle of the mesh's box at the terrain's, two of these at
/// once, heights off by a constant or a factor, and a shift of a few samples.
///
/// A placing's *misfit* is the mean of min(1, |z - h| / relief) over the vertices (at most a few
/// thousand, evenly chosen), relief being the terrain's; 1 for one beside the terrain.
///
///   (1) A placing is named if its misfit is at most 1/kFarBetter of the stated one's, nine tenths
///       of the vertices stand over the terrain, at no less than a hundredth of it, and they are a
///       quarter as far off as a level plane, or less: so that no shrinking to a point explains
///       anything. Of several the one with the fewest changes is named, unless another is better by
///       kFarBetter. A shift that leaves 1/kFarBetter of the distances is named however well the
///       mesh fits.
///   (2) Vertices that are samples of the terrain, or near them, are never refused, whatever the
///       level of detail; nor is a mesh that reaches beyond the terrain, if it fits where it stands
///       over it.
///   (3) If nothing is named, most vertices are beyond the tolerance (through `camera`, where it is
///       in pixels), and they are farther off than every level of detail (coarse_truths) is there,
///       the mesh is refused as that of another terrain or place.
/// mesh  as read_mesh(…, options) gives it. Nothing: the mesh fits.
std::optional<Misfit> misfit_of_mesh(const HeightfieldTruth& truth, const TriangleMesh& mesh,
                                     const terrain::MeshReadOptions& options, const Camera& camera,
                                     const Tolerance& tolerance);

}  // namespace plumb::audit
