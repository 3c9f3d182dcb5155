// Holes, overshoots and see-through places of a surface that is no heightfield.
#pragma once

#include "audit/coverage.h"
#include "audit/mesh_truth.h"
#include "audit/solid_nearest.h"

namespace plumb::audit {

/// Compares what is drawn with what a mesh's truth demands, by the band along silhouettes that
/// coverage.h has.
///
/// hole         nothing is drawn, and the truth is hit at all pixels within the band; no truth ray
///              between their centres misses; and what the truth shows is not drawn within the
///              band, or does not let the ray pass there (MeshBandWalk)
/// overshoot    something is drawn, farther from the truth than the band, and the truth is missed
///              at all pixels within the band; no truth ray between their centres hits
/// see-through  the truth is hit all around, the drawn point lies behind all of it, also between
///              the centres; the point of the drawn surface that is nearest to the truth's is
///              farther from it than the band, on the screen and in metres; and the truth nearest
///              to the drawn point is itself hidden. So nothing stands where the truth does, and
///              what is drawn is what the truth hides. What is merely displaced is the nearest
///              error's matter
///
/// band      where it has metres, rays are cast as far around as those reach on the screen
/// to_drawn  the drawn mesh, asked for nearest points
Coverage solid_coverage_of(const MeshTruth& truth, const HitImage& true_hits, const HitImage& drawn,
                           const Camera& camera, const DrawnSurface& surface,
                           const NearestSide& to_drawn, const Band& band, int most_listed = 100);

}  // namespace plumb::audit
