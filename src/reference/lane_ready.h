// Rays made ready for the walk of lane_walk_kernel.h. Included as that is.
#pragma once

#include "reference/lane_walk.h"

namespace plumb::reference {
namespace {

constexpr double kFewRoundings = 8.0 * 2.220446049250313e-16;
constexpr double kStill = 1e-30;  // as the careful walk has it

// Rays made ready, in units of cells.
struct ReadyRays {
  double du[LaneRays::kPadded], dv[LaneRays::kPadded], dz[LaneRays::kPadded];
  double inverse_du[LaneRays::kPadded], inverse_dv[LaneRays::kPadded];
  double begin[LaneRays::kPadded];  // where the walk begins and ends
  double end[LaneRays::kPadded];
  double t_low[LaneRays::kPadded];  // least t that counts
};

// Rays k and following, a lane each.
template <class L>
PLUMB_INLINE void make_ready(const LaneScene& scene, LaneRays& rays, ReadyRays& ready, int k) {
  using Real = typename L::Real;
  using Mask = typename L::Mask;
  constexpr double kInfinity = __builtin_inf();
  const Real zero = L::all(0.0), one = L::all(1.0);
  const Real u = L::all(scene.u), v = L::all(scene.v), z = L::all(scene.z);
  const Real du = L::load(rays.direction_x + k) / L::all(scene.dx_m);
  const Real dv = L::load(rays.direction_y + k) / L::all(scene.dy_m);
  const Real dz = L::load(rays.direction_z + k);
  const Real size_u = L::magnitude(du), size_v = L::magnitude(dv);
  const Real still = L::all(kStill) * L::greatest(L::greatest(size_u, size_v), L::magnitude(dz));
  const Mask along_grid =
      L::either(L::either(L::less(size_u, still), L::less(size_v, still)), L::equal(dz, zero));
  const Real inverse_du = one / du, inverse_dv = one / dv;

  const Real a = (L::all(scene.lowest) - z) / dz, b = (L::all(scene.highest) - z) / dz;
  const Real slack = L::all(kFewRoundings) * L::greatest(L::magnitude(a), L::magnitude(b));
  const Real t_low = L::greatest(L::all(scene.t_min), L::least(a, b) - slack);
  const Real t_high = L::least(L::all(scene.t_max), L::greatest(a, b) + slack);
  const Real west = (zero - u) * inverse_du, east = (L::all(scene.cell_columns) - u) * inverse_du;
  const Real south = (zero - v) * inverse_dv, north = (L::all(scene.cell_rows) - v) * inverse_dv;
  const Real begin = L::greatest(L::greatest(L::least(west, east), L::least(south, north)),
                                 L::greatest(t_low, L::all(rays.t_begin)));
  const Real end = L::least(L::least(L::greatest(west, east), L::greatest(south, north)), t_high);

  // A ray that only touches the surface's box.
  const Mask touches =
      L::less_equal(L::magnitude(end - begin),
                    L::all(kFewRoundings) * L::greatest(L::magnitude(begin), L::magnitude(end)));
  const Mask undecided = L::either(along_grid, touches);

  L::store(ready.du + k, du);
  L::store(ready.dv + k, dv);
  L::store(ready.dz + k, dz);
  L::store(ready.inverse_du + k, inverse_du);
  L::store(ready.inverse_dv + k, inverse_dv);
  L::store(ready.begin + k, begin);
  L::store(ready.end + k, L::choose(undecided, L::all(-kInfinity), end));
  L::store(ready.t_low + k, t_low);
  const unsigned marks = L::bits(undecided);
  for (int lane = 0; lane < L::kCount; ++lane) {
    rays.undecided[k + lane] = (marks >> lane & 1u) != 0;
    rays.t[k + lane] = rays.undecided[k + lane] ? -kInfinity : kInfinity;
    rays.triangle[k + lane] = 0xffffffffu;
  }
}

}  // namespace
}  // namespace plumb::reference
