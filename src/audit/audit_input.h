// What an audit takes: pictures and a surface that belong together.
#pragma once

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// Throws std::invalid_argument unless both pictures have the camera's size, `drawn` names
/// primitives of the surface, and the surface's lists agree with each other.
void require_consistent(const HitImage& true_hits, const DrawnSurface& surface,
                        const HitImage& drawn, const Camera& camera);

}  // namespace plumb::audit
