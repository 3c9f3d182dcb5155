// The same view of the terrain mirrored and turned: what a frame of some other ground looks like.
// Not for users of the library.
#pragma once

#include <vector>

#include "audit/truth.h"
#include "core/camera.h"

namespace plumb::audit {

/// The seven cameras that see the terrain as `camera` would if it were mirrored or turned by
/// quarters about its middle, as high above the ground as `camera` is. Their axes may be
/// left-handed.
std::vector<Camera> turned_cameras(const HeightfieldTruth& truth, const Camera& camera);

}  // namespace plumb::audit
