// Every quad of a cut, one after the other: what the ray-slicer's walk is compared with.
#pragma once

#include <cstdint>

#include "slicing/slice_ray.h"
#include "slicing/slicing_cut.h"

namespace plumb::test_support {

/// Calls visit(bundle, kind, axis, met) for every quad that the ray meets at `near_m` or beyond.
template <class Visit>
void for_each_quad_met(const slicing::SlicingCut& cut, const slicing::SliceRay& ray, double near_m,
                       const Visit& visit) {
  using slicing::Axis;
  for (std::uint32_t number = 0; number < cut.bundles.size(); ++number) {
    const slicing::SliceBundle& bundle = cut.bundles[number];
    const auto quad = [&](slicing::QuadKind kind, Axis axis, double at_m) {
      if (ray.direction[index_of(axis)] == 0.0) return;
      const slicing::PlanePoint met = meet_plane(ray, axis, at_m);
      if (met.t >= near_m && is_on_quad(bundle, kind, axis, met.point_m))
        visit(number, kind, axis, met);
    };
    for (int j = 0; j < bundle.count; ++j)
      quad(slicing::QuadKind::Slice, bundle.axis, bundle.plane_m(j));
    if (!bundle.closed) continue;
    for (const Axis axis : {Axis::X, Axis::Y})
      for (const double at_m :
           {bundle.reach.low[index_of(axis)], bundle.reach.high[index_of(axis)]})
        quad(slicing::QuadKind::Closing, axis, at_m);
    quad(slicing::QuadKind::Closing, Axis::Z, bundle.reach.low.z);
  }
}

}  // namespace plumb::test_support
