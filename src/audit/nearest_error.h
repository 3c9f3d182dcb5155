// The distance on screen between what a pixel shows and the nearest point of the other surface.
#pragma once

#include <vector>

#include "audit/pixel_error.h"

namespace plumb::audit {

/// From each drawn point to the nearest of the truth, pixels, one entry a pixel; NaN where nothing
/// is drawn, +inf where there is no truth within `vertical`'s distance.
///
/// vertical  vertical_errors of the same picture: the truth above or below a point bounds how far
/// off the nearest may be, and within truth.slack_m of it the error counts as none.
std::vector<float> forward_nearest_errors(const HeightfieldTruth& truth, const HitImage& drawn,
                                          const PixelErrors& vertical, const Camera& camera);

/// And from each point of the truth to the nearest of the drawn mesh; `vertical` is
/// reverse_vertical_errors of the same picture.
std::vector<float> reverse_nearest_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                                          const ReversePixelErrors& vertical,
                                          const TriangleMesh& mesh, const Camera& camera);

}  // namespace plumb::audit
