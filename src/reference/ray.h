// Rays, and where they end.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>

#include "core/triangle_mesh.h"

namespace plumb::reference {

/// origin_m + t * direction for t in [t_min, t_max]; the direction need not be a unit vector. A
/// camera's rays are scaled to view depth one, so that t is the view depth.
struct Ray {
  glm::dvec3 origin_m{0.0};  // in the coordinates of the terrain or mesh, relative to its origin
  glm::dvec3 direction{0.0, 1.0, 0.0};
  double t_min = 0.0;
  double t_max = std::numeric_limits<double>::infinity();
};

/// The first point of a surface on a ray, from either side.
struct RayHit {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoPrimitive;

  explicit operator bool() const { return triangle != kNoPrimitive; }
  friend bool operator==(const RayHit&, const RayHit&) = default;
};

}  // namespace plumb::reference
