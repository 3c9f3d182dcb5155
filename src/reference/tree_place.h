// Where a tree of boxes in single precision lies, and where rays in double enter it.
#pragma once

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/box.h"
#include "reference/ray.h"

namespace plumb::reference {

constexpr double kSingleUlp = 1.0 / (1 << 22);  // four roundings to single precision

/// A float at or beyond a double, away from zero; cheaper than the next one.
inline float single_beyond(double x) { return static_cast<float>(x + std::abs(x) * kSingleUlp); }

/// A ray from where it enters a tree's box, relative to the tree's middle, its direction's longest
/// coordinate 1: its t is the ray's t * scale - start, up to `length`.
struct TreeEntry {
  glm::dvec3 origin, direction;
  double length, scale, start;
};

/// A tree's coordinates are relative to the middle of all its boxes, which are widened by the
/// margin.
struct TreePlace {
  Box bounds;
  glm::dvec3 middle{0.0};
  double margin = 0.0;

  TreePlace() = default;
  explicit TreePlace(const Box& all) : bounds(all), middle(0.5 * (all.low + all.high)) {
    constexpr double kMargin = 1.0 / (1 << 18);  // of the longest side; see box_tree.h
    margin = kMargin * longest(all.high - all.low);
    if (margin == 0.0) margin = std::numeric_limits<float>::min();
    entered_ = {all.low - middle - 2.0 * margin, all.high - middle + 2.0 * margin};
    longest_m_ = longest(entered_.high - entered_.low);
  }

  /// False for a ray that does not come near any box.
  bool enter(const Ray& ray, TreeEntry& entry) const {
    entry.scale = longest(glm::abs(ray.direction));
    // Where the reciprocal is as exact as any number.
    const bool ordinary = entry.scale > 1e-290 && entry.scale < 1e290;
    entry.direction = ordinary ? ray.direction * (1.0 / entry.scale) : ray.direction / entry.scale;
    const glm::dvec3 origin = ray.origin_m - middle;
    double low = ray.t_min * entry.scale, high = ray.t_max * entry.scale;
    if (is_inside(origin)) {
      // No farther than along its longest side: one coordinate of the direction is 1.
      high = std::min(high, longest_m_);
      if (!(low <= high)) return false;
    } else if (!cut(origin, entry.direction, low, high)) {
      return false;
    }
    entry.origin = origin + low * entry.direction;
    entry.length = high - low + margin;
    entry.start = low;
    return true;
  }

  static double longest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

 private:
  bool is_inside(const glm::dvec3& p) const {
    return p.x >= entered_.low.x && p.y >= entered_.low.y && p.z >= entered_.low.z &&
           p.x <= entered_.high.x && p.y <= entered_.high.y && p.z <= entered_.high.z;
  }

  // Cuts [low, high] to where origin + s * direction lies in the box. False if nothing is left. A
  // coordinate of the direction below 1e-30 does not leave its side of the box.
  bool cut(const glm::dvec3& origin, const glm::dvec3& direction, double& low, double& high) const {
    constexpr double kStill = 1e-30;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(direction[axis]) < kStill) {
        if (origin[axis] < entered_.low[axis] || origin[axis] > entered_.high[axis]) return false;
        continue;
      }
      const double inverse = 1.0 / direction[axis];
      const double a = (entered_.low[axis] - origin[axis]) * inverse;
      const double b = (entered_.high[axis] - origin[axis]) * inverse;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
    return low <= high;
  }

  Box entered_;             // `bounds` with the margin twice, relative to the middle
  double longest_m_ = 0.0;  // its longest side
};

}  // namespace plumb::reference
