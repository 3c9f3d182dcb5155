// Pixels in which a solid and a sheet are different things.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/truth.h"
#include "core/camera.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// Slices draw the ground as a solid, the truth is a sheet without thickness. A ray that gets below
/// the ground without crossing a triangle (round the rim, through a void, from an eye below ground)
/// sees the solid at once and the sheet from below, or never. Such pixels say nothing about the
/// method.
///
/// returns 1 for a pixel whose truth shows the underside of a triangle, and for one whose drawn
/// point lies below the ground and whose ray, followed back from there, does not come out through
/// a triangle: it lies before the truth's, or, on a terrain with voids, a ray cast back meets none
/// from below. (A surface that is lowered within its tolerance may let a ray pass where the truth
/// stops it, and what lies behind may be void.)
std::vector<std::uint8_t> rays_below_ground(const HeightfieldTruth& truth,
                                            const HitImage& true_hits, const HitImage& drawn,
                                            const Camera& camera);

/// The picture without the pixels that are set aside.
HitImage without(HitImage picture, const std::vector<std::uint8_t>& set_aside);

}  // namespace plumb::audit
