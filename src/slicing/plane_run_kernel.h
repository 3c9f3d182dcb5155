// Written once for every number of lanes; see reference/lane_walk_kernel.h for who may include it.
#pragma once

#include "slicing/plane_run.h"

namespace plumb::slicing {
namespace {

// Lanes where the ground at (x, y) is at or above z; HeightLookup::height_m, triangulated.
template <class L>
typename L::Mask is_at_or_below(const PlaneRunHeights& h, typename L::Real x, typename L::Real y,
                                typename L::Real z, typename L::Mask asked) {
  using Real = typename L::Real;
  const Real zero = L::all(0.0), one = L::all(1.0), rim = L::all(1e-9);
  const Real columns = L::all(h.cell_columns), rows = L::all(h.cell_rows);
  Real u = x * L::all(h.columns_per_m), v = y * L::all(h.rows_per_m);
  asked =
      L::both(asked, L::both(L::both(L::less_equal(zero - rim, u), L::less_equal(u, columns + rim)),
                             L::both(L::less_equal(zero - rim, v), L::less_equal(v, rows + rim))));
  if (L::bits(asked) == 0) return asked;
  u = L::least(L::greatest(u, zero), columns);
  v = L::least(L::greatest(v, zero), rows);
  const Real i = L::least(L::floor(u), columns - one), j = L::least(L::floor(v), rows - one);
  const Real a = u - i, b = v - j;
  const Real index = j * L::all(h.columns) + i;
  const auto south = L::template gather<1>(h.heights_m, index, asked);
  const auto north = L::template gather<1>(h.heights_m + h.columns, index, asked);
  const Real sw = south.first, se = south.second, nw = north.first, ne = north.second;

  const Real half = L::all(0.5), place = i + j;
  const auto rises = L::equal(L::floor(place * half) * L::all(2.0), place);
  const auto south_east = L::less_equal(b, a), south_west = L::less_equal(a + b, one);
  const Real rising = L::choose(south_east, (one - a) * sw + (a - b) * se + b * ne,
                                (one - b) * sw + a * ne + (b - a) * nw);
  const Real falling = L::choose(south_west, (one - a - b) * sw + a * se + b * nw,
                                 (one - b) * se + (a + b - one) * ne + (one - a) * nw);
  return L::both(asked, L::less_equal(z, L::choose(rises, rising, falling)));
}

template <class L>
PlaneRunEnd meet_planes_of(const PlaneRun& run, const PlaneRunHeights& heights) {
  using Real = typename L::Real;
  static constexpr double kAhead[8] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  const Real best = L::all(run.best_t), end = L::all(run.count);
  const Real least_z = L::all(run.least_z_m), greatest_z = L::all(run.greatest_z_m);
  PlaneRunEnd result;
  for (int k = 0; k < run.count; k += L::kCount) {
    const Real ahead = L::all(k) + L::load(kAhead);
    const Real plane = L::all(run.first_plane) + ahead * L::all(run.step);
    const Real at = L::all(run.first_m) + plane * L::all(run.spacing_m);
    const Real t = (at - L::all(run.eye_m[run.axis])) * L::all(run.inverse);
    const auto there = L::less(ahead, end);
    const auto behind = L::both(there, L::less(best, t));
    auto on_quad = L::both(L::both(there, L::less_equal(L::all(run.near_t), t)),
                           L::less_equal(t, L::all(run.far_t)));
    Real point[3];
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = L::all(run.eye_m[axis]) + t * L::all(run.direction[axis]);
      if (axis == run.axis) {
        point[axis] = at;
        continue;
      }
      on_quad = L::both(on_quad, L::both(L::less_equal(L::all(run.low_m[axis]), point[axis]),
                                         L::less_equal(point[axis], L::all(run.high_m[axis]))));
    }
    const Real lowered = point[2] - L::all(run.raise_m);
    const Real z = L::choose(L::less(lowered, least_z), least_z,
                             L::choose(L::less(greatest_z, lowered), greatest_z, lowered));
    const auto passes = is_at_or_below<L>(heights, point[0], point[1], z, on_quad);
    const unsigned met = L::bits(on_quad), over = L::bits(behind), passing = L::bits(passes);
    const unsigned stop = over | passing;
    if (stop == 0) {
      result.tested += __builtin_popcount(met);
      continue;
    }
    const int lane = __builtin_ctz(stop);
    const unsigned before = (1u << lane) - 1u;
    result.tested += __builtin_popcount(met & before);
    if ((over >> lane) & 1u) return result;
    ++result.tested;
    double of_lane[L::kCount];
    L::store(of_lane, t);
    result.plane = k + lane;
    result.t = of_lane[lane];
    return result;
  }
  return result;
}

}  // namespace
}  // namespace plumb::slicing
