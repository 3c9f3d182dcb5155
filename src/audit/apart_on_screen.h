// How far two points lie apart on the screen.
#pragma once

#include <cmath>
#include <limits>

#include "core/camera.h"

namespace plumb::audit {

/// |proj(q) - proj(p)| in pixels, both in the camera's coordinates; +inf if one is not before the
/// eye.
inline double apart_on_screen(const Camera& camera, const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec3 a = to_view(camera, p), b = to_view(camera, q);
  if (!(a.z > 0.0) || !(b.z > 0.0)) return std::numeric_limits<double>::infinity();
  const glm::dvec2 d = view_to_pixel(camera, a) - view_to_pixel(camera, b);
  return std::sqrt(glm::dot(d, d));
}

}  // namespace plumb::audit
