// An axis-aligned box.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>

namespace plumb {

/// A closed box [low, high], metres; empty (low > high) until something is added.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  void add(const glm::dvec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  void add(const Box& other) {
    if (other.empty()) return;
    add(other.low);
    add(other.high);
  }
  /// Corner k in 0..7: bit 0 chooses x, bit 1 y, bit 2 z; a set bit takes the high side.
  glm::dvec3 corner(int k) const {
    return {k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z};
  }
  friend bool operator==(const Box&, const Box&) = default;
};

}  // namespace plumb
