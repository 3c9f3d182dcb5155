// Pixels in which a solid and a sheet are different things.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/band_walk.h"
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
/// point lies below the ground and whose ray did not get there through a triangle. That is so if it
/// lies before the truth's; and, on a terrain with voids, if it lies below the band and a ray cast
/// back from it comes out through no triangle, or so near to a void's rim that a surface within the
/// band lets it slip below.
std::vector<std::uint8_t> rays_below_ground(const HeightfieldTruth& truth,
                                            const HitImage& true_hits, const HitImage& drawn,
                                            const Camera& camera, const Band& band);

/// The picture without the pixels that are set aside.
HitImage without(HitImage picture, const std::vector<std::uint8_t>& set_aside);

}  // namespace plumb::audit
