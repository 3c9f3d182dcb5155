// A ray on its way through the cells of a heightfield, and what it has found.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reference/ray.h"

namespace plumb::reference {

struct Interval {
  double low, high;
};

/// More than the roundings of two divisions by which grid lines are met.
inline double t_slack(const Interval& t) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  return 8.0 * kEpsilon * std::max(std::abs(t.low), std::abs(t.high));
}

/// A ray in units of cells across and up and metres of height, with what the walk has found so far.
struct CarefulRay {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  double u, v, z;     // origin
  double du, dv, dz;  // direction
  double inverse_du, inverse_dv;
  double t_min, t_max;
  double t_from = -kNoLimit;  // nothing that ends before is looked at
  double height_slack;  // more than the roundings of z + t * dz and of a height between samples

  double place_slack;  // more than the roundings of u + t * du, cells
  Ray ray;             // as given, for what is decided without walking

  RayHit best;
  bool uncertain =
      false;  // something in the cell at hand is nearer to an edge than rounding can tell
  // On which side of the surface the ray was when last seen, and at which t: 1 above, -1 below, 0
  // unknown. A cell that begins at that very t on the other side is entered through the surface
  // (two roundings of the same edge).
  int side = 0;
  double side_t = -kNoLimit;

  // Where the ray is between the grid lines `low` and `high`; the same line gives the same t for
  // all cells that share it.
  static Interval between_lines(double origin, double step, double inverse, int low, int high) {
    if (step == 0.0)
      return low <= origin && origin <= high ? Interval{-kNoLimit, kNoLimit}
                                             : Interval{kNoLimit, -kNoLimit};
    const double a = (low - origin) * inverse, b = (high - origin) * inverse;
    return step > 0.0 ? Interval{a, b} : Interval{b, a};
  }
  Interval inside(int i0, int j0, int i1, int j1) const {
    const Interval across = between_lines(u, du, inverse_du, i0, i1);
    const Interval up = between_lines(v, dv, inverse_dv, j0, j1);
    return {std::max({across.low, up.low, t_min}), std::min({across.high, up.high, t_max})};
  }

  void found(double t, std::uint32_t triangle) {
    if (t < best.t || (t == best.t && triangle < best.triangle)) best = {t, triangle};
  }
};

}  // namespace plumb::reference
