// A point that a picture shows, as rounding leaves it.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::audit {

/// The largest of the coordinates, without their signs.
inline double largest_coordinate(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// How far off a drawn point may be, metres: it is a sum of the eye and a ray, rounded at their
/// length a few times over. `reach_m` is the ray's largest coordinate.
inline double drawn_point_slack_m(double reach_m) {
  return 8.0 * std::numeric_limits<double>::epsilon() * reach_m;
}

}  // namespace plumb::audit
