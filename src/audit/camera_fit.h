// The camera that a frame was seen through, near the stated one. Not for users of the library.
#pragma once

#include <string>

#include "audit/depth_samples.h"
#include "core/camera.h"

namespace plumb::audit {

/// From `stated`, by damped steps of Gauss and Newton, to the camera whose view of the truth
/// differs least from the frame: its eye, the way it looks, and its angle of view. `ranges` is the
/// frame as stated. A start that is too far off ends at some other camera, which explains little.
///
/// Differences are 2 (a - b) / (a + b) of the depths of pixels that show ground in both, weighted
/// so that large ones count by their size, not its square.
Camera fitted_camera(const DepthSamples& samples, const DepthRanges& ranges, const Camera& stated);

/// "its eye stands (0, 200, -3.1) m from the stated place (east, north, up), it looks 2.5 degrees
/// beside the stated way and its angle of view is 1.1 times as wide"; what differs by next to
/// nothing is left out.
std::string camera_text(const Camera& fitted, const Camera& stated);

}  // namespace plumb::audit
