// Written once for every number of lanes. Included by one file for each instruction set, which call
// no inline function that others share.
#pragma once

#include "raster/vertex_kernel.h"

namespace plumb::raster {
namespace {

template <class L>
class VertexKernel {
  using Real = typename L::Real;
  using Mask = typename L::Mask;
  static constexpr int kBatch = 64;  // vertices turned from records to columns at a time

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

  struct Columns {
    double x[kBatch], y[kBatch], z[kBatch];
  };
  struct Out {
    std::int32_t x[kBatch], y[kBatch];
    double inverse_depth[kBatch];
  };

  // Lanes k and following. Returns whether all are usable.
  bool transform(const Columns& in, int k, Out& out) const {
    const Real from_x = L::load(in.x + k) + L::all(to_.origin[0]);
    const Real from_y = L::load(in.y + k) + L::all(to_.origin[1]);
    const Real from_z = L::load(in.z + k) + L::all(to_.origin[2]);
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
    L::store_whole(out.x + k, snapped(window_x));
    L::store_whole(out.y + k, snapped(window_y));
    L::store(out.inverse_depth + k, L::all(1.0) / w);
    constexpr unsigned kAll = (1u << L::kCount) - 1u;
    for (unsigned left = kAll & ~all_inside; left; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      unsigned code = 0;
      for (unsigned plane = 0; plane < 5; ++plane) code |= (~inside[plane] >> lane & 1u) << plane;
      out.x[k + lane] = to_.clipped;
      out.y[k + lane] = static_cast<std::int32_t>(code);
      out.inverse_depth[k + lane] = 0.0;
    }
    return L::bits(usable) == kAll;
  }

 public:
  explicit VertexKernel(const WindowTransform& to) : to_(to) {}

  bool run(const double* vertices, std::int64_t count, ScreenVertex* window) const {
    Columns in;
    Out out;
    bool usable = true;
    for (std::int64_t first = 0; first < count; first += kBatch) {
      const int here = count - first < kBatch ? static_cast<int>(count - first) : kBatch;
      for (int k = 0; k < kBatch; ++k) {
        const double* vertex = vertices + 3 * (first + (k < here ? k : 0));
        in.x[k] = vertex[0];
        in.y[k] = vertex[1];
        in.z[k] = vertex[2];
      }
      for (int k = 0; k < here; k += L::kCount) usable &= transform(in, k, out);
      for (int k = 0; k < here; ++k) {
        ScreenVertex& to = window[first + k];
        to.x = out.x[k];
        to.y = out.y[k];
        to.inverse_depth = out.inverse_depth[k];
      }
    }
    return usable;
  }
};

}  // namespace
}  // namespace plumb::raster
