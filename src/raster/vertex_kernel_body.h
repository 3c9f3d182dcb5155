// Written once for every number of lanes. Included by one file for each instruction set, which call
// no inline function that others share.
#pragma once

#include <cstddef>

#include "raster/vertex_kernel.h"

namespace plumb::raster {
namespace {

template <class L>
class VertexKernel {
  using Real = typename L::Real;
  using Mask = typename L::Mask;
  static constexpr unsigned kAll = (1u << L::kCount) - 1u;

  const WindowTransform& to_;

  static Real dot(const double* axis, Real x, Real y, Real z) {
    return (x * L::all(axis[0]) + y * L::all(axis[1])) + z * L::all(axis[2]);
  }
  // floor(256 * px + 0.5), within what coordinates may be.
  static Real snapped(Real px) {
    const Real most = L::all(kLargestCoordinate), least = L::all(-kLargestCoordinate);
    const Real scaled = px * L::all(kSubpixels) + L::all(0.5);
    return L::floor(L::least(L::greatest(scaled, least), most));
  }

  // kCount vertices. Returns whether all are usable.
  bool transform(const double* vertices, ScreenVertex* window) const {
    static_assert(sizeof(ScreenVertex) == 16 && offsetof(ScreenVertex, inverse_depth) == 8);
    Real from_x, from_y, from_z;
    L::load_points(vertices, from_x, from_y, from_z);
    from_x = from_x + L::all(to_.origin[0]);
    from_y = from_y + L::all(to_.origin[1]);
    from_z = from_z + L::all(to_.origin[2]);
    const Real far = L::all(to_.farthest);
    const Mask usable = L::both(
        L::both(L::less_equal(L::magnitude(from_x), far), L::less_equal(L::magnitude(from_y), far)),
        L::less_equal(L::magnitude(from_z), far));
    const Real x = dot(to_.right, from_x, from_y, from_z);
    const Real y = dot(to_.up, from_x, from_y, from_z);
    const Real w = dot(to_.forward, from_x, from_y, from_z);

    const Real zero = L::all(0.0);
    const Real wide = L::all(to_.gamma_h) * x, high = L::all(to_.gamma_v) * y;
    const unsigned inside[] = {
        L::bits(L::less_equal(zero, w - L::all(to_.near))),
        L::bits(L::less_equal(zero, wide + L::all(to_.guard_left) * w)),
        L::bits(L::less_equal(zero, L::all(to_.guard_right) * w - wide)),
        L::bits(L::less_equal(zero, L::all(to_.guard_top) * w - high)),
        L::bits(L::less_equal(zero, high + L::all(to_.guard_bottom) * w)),
    };
    const unsigned all_inside = inside[0] & inside[1] & inside[2] & inside[3] & inside[4];
    const Real window_x = L::all(to_.centre_x) + L::all(to_.gamma_h) * (x / w);
    const Real window_y = L::all(to_.centre_y) - L::all(to_.gamma_v) * (y / w);
    L::store_records(window, snapped(window_x), snapped(window_y), L::all(1.0) / w);
    for (unsigned left = kAll & ~all_inside; left; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      unsigned code = 0;
      for (unsigned plane = 0; plane < 5; ++plane) code |= (~inside[plane] >> lane & 1u) << plane;
      window[lane].x = to_.clipped;
      window[lane].y = static_cast<std::int32_t>(code);
      window[lane].inverse_depth = 0.0;
    }
    return L::bits(usable) == kAll;
  }

 public:
  explicit VertexKernel(const WindowTransform& to) : to_(to) {}

  bool run(const double* vertices, std::int64_t count, ScreenVertex* window) const {
    bool usable = true;
    std::int64_t first = 0;
    for (; first + L::kCount <= count; first += L::kCount)
      usable &= transform(vertices + 3 * first, window + first);
    if (first == count) return usable;
    double last[3 * L::kCount];  // what is left, and the last vertex again
    ScreenVertex out[L::kCount];
    for (int k = 0; k < 3 * L::kCount; ++k) {
      const std::int64_t vertex = first + k / 3 < count ? first + k / 3 : count - 1;
      last[k] = vertices[3 * vertex + k % 3];
    }
    usable &= transform(last, out);
    for (std::int64_t k = first; k < count; ++k) window[k] = out[k - first];
    return usable;
  }
};

}  // namespace
}  // namespace plumb::raster
