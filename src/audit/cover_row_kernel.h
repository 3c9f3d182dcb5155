// Written once for every number of lanes; see reference/lane_walk_kernel.h for who may include it.
#pragma once

#include "audit/cover_row.h"

namespace plumb::audit {
namespace {

template <class L>
typename L::Real edge_function(double px, double py, double qx, double qy, double y,
                               typename L::Real x) {
  return (L::all(px) - x) * L::all(qy - y) - L::all(py - y) * (L::all(qx) - x);
}

template <class L>
double cover_samples_of(const CoverTriangle& t, const CoverRow& row, int first, int last) {
  using Real = typename L::Real;
  static constexpr double kAhead[8] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  const Real zero = L::all(0.0), slack = L::all(t.slack), end = L::all(last);
  Real largest = zero;
  for (int i = first; i <= last; i += L::kCount) {
    const Real column = L::all(i) + L::load(kAhead), x = column * L::all(row.dx_m);
    const Real at_a = edge_function<L>(t.bx, t.by, t.cx, t.cy, row.y_m, x);
    const Real at_b = edge_function<L>(t.cx, t.cy, t.ax, t.ay, row.y_m, x);
    const Real at_c = edge_function<L>(t.ax, t.ay, t.bx, t.by, row.y_m, x);
    const Real nearest = L::least(L::least(at_a, at_b), at_c);
    const auto covered = L::both(L::less_equal(zero - slack, nearest), L::less_equal(column, end));
    if (L::bits(covered) == 0) continue;
    const Real wa = L::greatest(at_a, zero), wb = L::greatest(at_b, zero),
               wc = L::greatest(at_c, zero);
    const Real z =
        L::all(t.az) + (wb * L::all(t.bz - t.az) + wc * L::all(t.cz - t.az)) / (wa + wb + wc);
    const Real delta = z - L::load(row.heights_m + i), distance = L::magnitude(delta);
    const Real before = L::load(row.delta_m + i), triangle = L::load(row.triangle + i);
    const auto worse = L::both(
        covered, L::either(L::less(L::magnitude(before), distance), L::less(triangle, zero)));
    L::store(row.delta_m + i, L::choose(worse, delta, before));
    L::store(row.triangle + i, L::choose(worse, L::all(t.index), triangle));
    const auto inside = L::both(covered, L::less(slack, nearest));
    L::store(row.sheets + i, L::load(row.sheets + i) + L::choose(inside, L::all(1.0), zero));
    // The second operand where one is NaN: over a void.
    largest = L::greatest(L::choose(covered, distance, zero), largest);
  }
  double lanes[L::kCount], most = 0.0;
  L::store(lanes, largest);
  for (const double lane : lanes) most = lane > most ? lane : most;
  return most;
}

}  // namespace
}  // namespace plumb::audit
