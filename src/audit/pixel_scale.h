// How many pixels a metre spans at most at a place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/camera.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// Largest displacement on screen of a metre in any direction, to first order: at view depth w and
/// tangents t = (x, y) / w the projection's derivative is (1, -t) / w, whose largest singular value
/// is sqrt(1 + |t|^2) / w. +inf at or behind the eye.
inline double pixels_per_metre(const Camera& camera, const glm::dvec3& from_eye_m) {
  const double w = glm::dot(from_eye_m, camera.forward);
  if (!(w > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(camera.gamma_h, camera.gamma_v) * std::sqrt(glm::dot(from_eye_m, from_eye_m)) /
         (w * w);
}

}  // namespace plumb::audit
