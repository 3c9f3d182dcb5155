// The answer of a nearest-point query.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>

#include "core/triangle_mesh.h"

namespace plumb::reference {

struct NearestPoint {
  glm::dvec3 point_m{0.0};  // relative to the surface's origin
  double distance_m = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoPrimitive;

  /// False if the surface has no point within the radius asked for.
  explicit operator bool() const { return triangle != kNoPrimitive; }
  friend bool operator==(const NearestPoint&, const NearestPoint&) = default;
};

}  // namespace plumb::reference
