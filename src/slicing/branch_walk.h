// The boxes of a cut along a ray, front to back.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "slicing/slice_ray.h"
#include "slicing/slicing_cut.h"

namespace plumb::slicing {

/// A stretch of a ray, in view depths.
struct Interval {
  double begin, end;
  bool empty() const { return !(begin <= end); }
};

/// Where the ray is inside the box, widened by more than the roundings of a difference and a
/// product.
inline Interval inside(const SliceRay& ray, const Box& box, Interval all) {
  constexpr double kWider = 1e-12;
  for (int k = 0; k < 3; ++k) {
    if (ray.direction[k] == 0.0) {
      if (!(ray.eye_m[k] >= box.low[k] && ray.eye_m[k] <= box.high[k])) return {1.0, 0.0};
      continue;
    }
    const double a = (box.low[k] - ray.eye_m[k]) * ray.inverse[k],
                 b = (box.high[k] - ray.eye_m[k]) * ray.inverse[k];
    const double first = std::min(a, b), last = std::max(a, b);
    all.begin = std::max(all.begin, first - kWider * std::abs(first));
    all.end = std::min(all.end, last + kWider * std::abs(last));
  }
  return all;
}

/// Calls visit(bundle, part) for each bundle whose reach the ray meets within `all`, front to back;
/// those that begin behind `last_t`, which `visit` may lower, are left out.
template <class Visit>
void walk_bundles(const SlicingCut& cut, const SliceRay& ray, const Interval& all,
                  const double& last_t, const Visit& visit) {
  if (cut.branches.empty()) return;
  // A ray that runs west meets the eastern children first, one that runs south the northern ones.
  const std::size_t east = ray.direction.x < 0.0 ? 1 : 0, north = ray.direction.y < 0.0 ? 2 : 0;
  std::array<std::uint32_t, 3 * 16 + 1> stack;
  std::size_t count = 0;
  stack[count++] = static_cast<std::uint32_t>(cut.branches.size()) - 1;
  while (count > 0) {
    const SliceBranch& branch = cut.branches[stack[--count]];
    const Interval part = inside(ray, branch.reach, all);
    if (part.empty() || part.begin > last_t) continue;
    if (branch.bundle != kNoPrimitive) {
      visit(branch.bundle, part);
      continue;
    }
    for (std::size_t k = 4; k-- > 0;) {
      const std::uint32_t below = branch.below[k ^ east ^ north];
      if (below != kNoPrimitive) stack[count++] = below;
    }
  }
}

/// Planes of a bundle.
struct PlaneRange {
  int low, high;  // empty if low > high
};

/// Those between the ends of a part of the ray, and one more at each end for the roundings; none
/// for a ray along the planes.
inline PlaneRange planes_within(const SliceBundle& bundle, const SliceRay& ray,
                                const Interval& part) {
  const int n = index_of(bundle.axis);
  const double step = ray.direction[n];
  if (step == 0.0) return {0, -1};
  const double from = ray.eye_m[n] + part.begin * step, to = ray.eye_m[n] + part.end * step;
  const auto plane_near = [&](double at) {
    const double j = bundle.spacing_m > 0.0 ? (at - bundle.first_m) / bundle.spacing_m : 0.0;
    return static_cast<int>(std::clamp(std::floor(j), -1.0, static_cast<double>(bundle.count)));
  };
  return {std::max(0, plane_near(std::min(from, to)) - 1),
          std::min(bundle.count - 1, plane_near(std::max(from, to)) + 1)};
}

/// Calls visit(axis, place) for the four sides and the bottom of a closed bundle.
template <class Visit>
void for_each_closing_quad(const SliceBundle& bundle, const Visit& visit) {
  visit(Axis::X, bundle.reach.low.x);
  visit(Axis::X, bundle.reach.high.x);
  visit(Axis::Y, bundle.reach.low.y);
  visit(Axis::Y, bundle.reach.high.y);
  visit(Axis::Z, bundle.reach.low.z);
}

}  // namespace plumb::slicing
