// Written once for every number of lanes; see reference/lane_walk_kernel.h for who may include it.
#pragma once

#include "slicing/slice_packet.h"
#include "slicing/slicing_cut.h"
#include "terrain/lane_heights.h"

namespace plumb::slicing {
namespace {

#define PLUMB_INLINE __attribute__((always_inline)) inline

// What lies below a place.
template <class L>
struct Ground {
  typename L::Real height_m;                // NaN where there is none
  typename L::Real a, b;                    // place in the cell, 0 .. 1
  typename L::Real sw_m, se_m, nw_m, ne_m;  // its corners
};

// HeightLookup::height_m, triangulated, in the lanes that are asked for.
template <class L, class Samples>
PLUMB_INLINE Ground<L> ground_at(const LaneHeights& h, const Samples& samples, typename L::Real x,
                                 typename L::Real y, typename L::Mask asked) {
  using Real = typename L::Real;
  const Real zero = L::all(0.0), one = L::all(1.0), rim = L::all(1e-9);
  const Real nothing = L::all(__builtin_nan(""));
  const Real columns = L::all(h.cell_columns), rows = L::all(h.cell_rows);
  Real u = x * L::all(h.columns_per_m), v = y * L::all(h.rows_per_m);
  asked =
      L::both(asked, L::both(L::both(L::less_equal(zero - rim, u), L::less_equal(u, columns + rim)),
                             L::both(L::less_equal(zero - rim, v), L::less_equal(v, rows + rim))));
  if (L::bits(asked) == 0) return {nothing, zero, zero, nothing, nothing, nothing, nothing};
  u = L::least(L::greatest(u, zero), columns);
  v = L::least(L::greatest(v, zero), rows);
  const Real i = L::least(L::floor(u), columns - one), j = L::least(L::floor(v), rows - one);
  const Real a = u - i, b = v - j;
  const Real index = j * L::all(h.samples.columns) + i;
  const auto south = samples.south(index, asked), north = samples.north(index, asked);
  const Real sw = south.first, se = south.second, nw = north.first, ne = north.second;

  const Real half = L::all(0.5), place = i + j;
  const auto rises = L::equal(L::floor(place * half) * L::all(2.0), place);
  const auto south_east = L::less_equal(b, a), south_west = L::less_equal(a + b, one);
  const Real rising = L::choose(south_east, (one - a) * sw + (a - b) * se + b * ne,
                                (one - b) * sw + a * ne + (b - a) * nw);
  const Real falling = L::choose(south_west, (one - a - b) * sw + a * se + b * nw,
                                 (one - b) * se + (a + b - one) * ne + (one - a) * nw);
  return {L::choose(asked, L::choose(rises, rising, falling), nothing), a, b, sw, se, nw, ne};
}

// One ray a lane.
template <class L, class Samples>
class LaneSlicer {
  using Real = typename L::Real;
  using Mask = typename L::Mask;

 public:
  LaneSlicer(const PacketScene& scene, const SlicePacket& packet, int first)
      : scene_(scene), samples_(scene.heights.samples) {
    for (int k = 0; k < 3; ++k) {
      eye_[k] = L::all(scene.eye_m[k]);
      direction_[k] = L::load(packet.direction[k] + first);
      inverse_[k] = L::load(packet.inverse[k] + first);
    }
    const int count = packet.count - first;
    live_ = L::mask(count >= L::kCount ? (1u << L::kCount) - 1u : (1u << count) - 1u);
    across_ = L::root(direction_[0] * direction_[0] + direction_[1] * direction_[1]);
    best_t_ = L::all(__builtin_inf());
    best_bundle_ = L::all(static_cast<double>(kNoPrimitive));
    tested_ = L::all(0.0);
    east_ = packet.direction[0][first] < 0.0 ? 1 : 0;
    north_ = packet.direction[1][first] < 0.0 ? 2 : 0;
  }

  void run() {
    std::uint32_t stack[3 * 16 + 1];
    int count = 0;
    stack[count++] = scene_.root;
    while (count > 0) {
      const SliceBranch& branch = scene_.branches[stack[--count]];
      Real begin, end;
      const Mask inside = enter(branch.reach, begin, end);
      if (L::bits(inside) == 0) continue;
      if (branch.bundle != kNoPrimitive) {
        meet_bundle(branch.bundle, begin, end, inside);
        continue;
      }
      for (int k = 3; k >= 0; --k) {
        const std::uint32_t below = branch.below[k ^ east_ ^ north_];
        if (below != kNoPrimitive) stack[count++] = below;
      }
    }
  }

  void store(SlicePacket& packet, int first) const {
    double t[L::kCount], bundle[L::kCount], tested[L::kCount];
    L::store(t, best_t_);
    L::store(bundle, best_bundle_);
    L::store(tested, tested_);
    for (int k = 0; k < L::kCount && first + k < packet.count; ++k) {
      packet.t[first + k] = t[k];
      packet.bundle[first + k] = static_cast<std::uint32_t>(bundle[k]);
      packet.tested[first + k] = static_cast<std::int32_t>(tested[k]);
    }
  }

 private:
  // Lanes that are inside the box somewhere between `begin` and `end`; branch_walk.h's inside().
  PLUMB_INLINE Mask enter(const Box& box, Real& begin, Real& end) const {
    const double *low = &box.low.x, *high = &box.high.x;
    const Real wider = L::all(1e-12);
    begin = L::all(scene_.near_t);
    end = L::all(scene_.far_t);
    for (int k = 0; k < 3; ++k) {
      const Real a = (L::all(low[k]) - eye_[k]) * inverse_[k],
                 b = (L::all(high[k]) - eye_[k]) * inverse_[k];
      const Real first = L::least(a, b), last = L::greatest(a, b);
      begin = L::greatest(begin, first - wider * L::magnitude(first));
      end = L::least(end, last + wider * L::magnitude(last));
    }
    return L::both(live_, L::without(L::less_equal(begin, end), L::less(best_t_, begin)));
  }

  PLUMB_INLINE void meet_bundle(std::uint32_t number, Real begin, Real end, Mask asked) {
    const SliceBundle& bundle = scene_.bundles[number];
    if (bundle.closed) meet_closing_quads(number, asked);
    const int n = static_cast<int>(bundle.axis);
    const Mask ascending = L::both(asked, L::less(L::all(0.0), direction_[n]));
    const Mask descending = L::without(asked, ascending);
    Real low, high;
    planes_within(bundle, n, begin, L::least(end, best_t_), low, high);
    if (L::bits(ascending) != 0) meet_planes(number, n, low, high, ascending, true);
    if (L::bits(descending) != 0) meet_planes(number, n, low, high, descending, false);
  }

  // branch_walk.h's planes_within().
  PLUMB_INLINE void planes_within(const SliceBundle& bundle, int n, Real begin, Real end, Real& low,
                                  Real& high) const {
    const Real from = eye_[n] + begin * direction_[n], to = eye_[n] + end * direction_[n];
    const Real zero = L::all(0.0), one = L::all(1.0);
    low = high = zero;
    if (bundle.spacing_m > 0.0) {
      const Real first = L::all(bundle.first_m), spacing = L::all(bundle.spacing_m);
      const Real least = L::all(-1.0), most = L::all(bundle.count);
      low = L::floor(L::least(L::greatest((L::least(from, to) - first) / spacing, least), most));
      high =
          L::floor(L::least(L::greatest((L::greatest(from, to) - first) / spacing, least), most));
    }
    low = L::greatest(low - one, zero);
    high = L::least(high + one, L::all(bundle.count - 1.0));
  }

  // A bundle's planes for the lanes that meet them in one order; places are counted from the
  // nearest, plane = origin + step * place.
  struct Run {
    const SliceBundle* bundle;
    int n;
    double origin, step;
    Real first, last;  // of each lane: its planes that are met on their quads

    PLUMB_INLINE Real plane_m(Real place) const {
      return L::all(bundle->first_m) +
             (L::all(origin) + L::all(step) * place) * L::all(bundle->spacing_m);
    }
  };

  // Planes low .. high of each lane, nearest first, until one passes or is no longer the nearest.
  PLUMB_INLINE void meet_planes(std::uint32_t number, int n, Real low, Real high, Mask open,
                                bool ascending) {
    const SliceBundle& bundle = scene_.bundles[number];
    const Real one = L::all(1.0);
    Run run{&bundle, n, ascending ? 0.0 : bundle.count - 1.0, ascending ? 1.0 : -1.0, low, high};
    if (!ascending) {
      run.first = L::all(run.origin) - high;
      run.last = L::all(run.origin) - low;
    }
    open = find_ends(run, open);
    if (L::bits(open) == 0) return;
    const Strides strides = strides_in(bundle, n);
    Real place = run.first;
    while (L::bits(open) != 0) {
      Real t, point[3], z;
      Ground<L> ground;
      meet_quad(bundle, n, run.plane_m(place), 0.0, t, point);
      const Mask passes = see(number, t, point, bundle.raise_m, open, z, ground);
      tested_ = tested_ + L::choose(passes, place - run.first + one, L::all(0.0));
      open = L::without(open, passes);
      place = place + planes_ahead(strides, z, ground);
      const Mask left = L::less_equal(place, run.last);
      tested_ =
          tested_ + L::choose(L::without(open, left), run.last - run.first + one, L::all(0.0));
      open = L::both(open, left);
    }
  }

  // How a ray moves from one plane of a bundle to the next, and how far above the ground it may be
  // to meet it there.
  struct Strides {
    Real planes_per_m;  // fewer than take it to the ground from a metre above, on any slope
    Real slack_m;
    Real columns, rows, falls_m;         // moved
    Real planes_a_column, planes_a_row;  // that it takes to cross a cell
    Mask east, north;
  };

  PLUMB_INLINE Strides strides_in(const SliceBundle& bundle, int n) const {
    const Real one = L::all(1.0), zero = L::all(0.0);
    const Real t = L::all(bundle.spacing_m) * L::magnitude(inverse_[n]);
    Strides s;
    s.planes_per_m = L::all(0.999999999) /
                     (t * (L::all(bundle.steepest) * across_ + L::magnitude(direction_[2])));
    s.slack_m = L::all(scene_.rounding_m * (1.0 + bundle.steepest));
    s.columns = t * direction_[0] * L::all(scene_.heights.columns_per_m);
    s.rows = t * direction_[1] * L::all(scene_.heights.rows_per_m);
    // A ray that climbs is tested no higher once it is at the top of its bundle.
    s.falls_m = L::least(t * direction_[2], zero);
    s.planes_a_column = one / L::magnitude(s.columns);
    s.planes_a_row = one / L::magnitude(s.rows);
    s.east = L::less(zero, direction_[0]);
    s.north = L::less(zero, direction_[1]);
    return s;
  }

  // Planes to the next one that may pass, at least one. Where something is not known: of a number
  // and none, `greatest` and `least` take their second.
  PLUMB_INLINE Real planes_ahead(const Strides& s, Real z, const Ground<L>& ground) const {
    const Real one = L::all(1.0), zero = L::all(0.0);
    const Real above = z - ground.height_m;
    const Real by_slope = L::greatest((above - s.slack_m) * s.planes_per_m, one);
    // In its cell the ground rises no more than the steeper of the edges on either side.
    const Real south = ground.se_m - ground.sw_m, north = ground.ne_m - ground.nw_m,
               west = ground.nw_m - ground.sw_m, east = ground.ne_m - ground.se_m;
    const Real rise = L::greatest(south * s.columns, north * s.columns) +
                      L::greatest(west * s.rows, east * s.rows) - s.falls_m;
    const Real spread =
        L::magnitude(south) + L::magnitude(north) + L::magnitude(west) + L::magnitude(east);
    const Real slack = L::all(scene_.rounding_m) + L::all(1e-9) * spread;
    const Real to_ground = (above - slack) / L::greatest(rise, L::all(1e-300));
    const Real column = L::choose(s.east, one - ground.a, ground.a) * s.planes_a_column,
               row = L::choose(s.north, one - ground.b, ground.b) * s.planes_a_row;
    const Real to_rim = L::least(column, row) - L::all(1e-6);
    const Real by_cell = L::greatest(L::least(to_rim, to_ground), one);
    const Real ahead = L::least(L::greatest(by_slope, by_cell), L::all(1e9));
    return zero - L::floor(zero - ahead);
  }

  // Cuts each lane's planes to those that it meets on their quads and not behind what is seen
  // already: t and the point are monotonic in the plane, so they are neighbours. Returns the lanes
  // that have any.
  PLUMB_INLINE Mask find_ends(Run& run, Mask asked) const {
    const Real one = L::all(1.0);
    asked = L::both(asked, L::less_equal(run.first, run.last));
    for (Mask off = asked;;) {
      off = L::without(off, is_met(run, run.first));
      off = L::both(off, L::less(run.first, run.last));
      if (L::bits(off) == 0) break;
      run.first = L::choose(off, run.first + one, run.first);
    }
    for (Mask off = asked;;) {
      off = L::without(off, is_met(run, run.last));
      off = L::both(off, L::less(run.first, run.last));
      if (L::bits(off) == 0) break;
      run.last = L::choose(off, run.last - one, run.last);
    }
    return L::both(asked, is_met(run, run.first));
  }

  PLUMB_INLINE Mask is_met(const Run& run, Real place) const {
    Real t, point[3];
    return meet_quad(*run.bundle, run.n, run.plane_m(place), 0.0, t, point);
  }

  // Where the rays meet a plane across axis `n`. Returns the lanes that meet it on its quad, which
  // is larger than the bundle's reach by rim_m, and not behind what is seen already.
  PLUMB_INLINE Mask meet_quad(const SliceBundle& bundle, int n, Real at, double rim_m, Real& t,
                              Real* point) const {
    const double *low = &bundle.reach.low.x, *high = &bundle.reach.high.x;
    t = (at - eye_[n]) * inverse_[n];
    Mask met = L::without(
        L::both(L::less_equal(L::all(scene_.near_t), t), L::less_equal(t, L::all(scene_.far_t))),
        L::less(best_t_, t));
    for (int k = 0; k < 3; ++k) {
      if (k == n) {
        point[k] = at;
        continue;
      }
      point[k] = eye_[k] + t * direction_[k];
      met = L::both(met, L::both(L::less_equal(L::all(low[k] - rim_m), point[k]),
                                 L::less_equal(point[k], L::all(high[k] + rim_m))));
    }
    return met;
  }

  PLUMB_INLINE void meet_closing_quads(std::uint32_t number, Mask asked) {
    const SliceBundle& bundle = scene_.bundles[number];
    const double *low = &bundle.reach.low.x, *high = &bundle.reach.high.x;
    for (int quad = 0; quad < 5; ++quad) {
      const int n = quad / 2;
      Real t, point[3], z;
      Ground<L> ground;
      const Mask met = L::both(asked, meet_quad(bundle, n, L::all(quad % 2 == 0 ? low[n] : high[n]),
                                                bundle.closing_rim_m, t, point));
      if (L::bits(met) == 0) continue;
      tested_ = tested_ + L::choose(met, L::all(1.0), L::all(0.0));
      see(number, t, point, bundle.closing_raise_m, met, z, ground);
    }
  }

  // Fragments at `point`, none of them behind what is seen already: sees those that pass, and
  // returns their lanes. They are tested at height z.
  PLUMB_INLINE Mask see(std::uint32_t number, Real t, const Real* point, double raise_m, Mask asked,
                        Real& z, Ground<L>& ground) {
    const SliceBundle& bundle = scene_.bundles[number];
    const Real lowered = point[2] - L::all(raise_m);
    const Real least_z = L::all(bundle.least_z_m), greatest_z = L::all(bundle.greatest_z_m);
    z = L::choose(L::less(lowered, least_z), least_z,
                  L::choose(L::less(greatest_z, lowered), greatest_z, lowered));
    ground = ground_at<L>(scene_.heights, samples_, point[0], point[1], asked);
    const Mask passes = L::less_equal(z, ground.height_m);
    const Real mine = L::all(static_cast<double>(number));
    const Mask nearer =
        L::both(passes, L::either(L::less(t, best_t_), L::less(mine, best_bundle_)));
    best_t_ = L::choose(nearer, t, best_t_);
    best_bundle_ = L::choose(nearer, mine, best_bundle_);
    return passes;
  }

  const PacketScene& scene_;
  Samples samples_;
  Real eye_[3], direction_[3], inverse_[3];
  Real across_;  // length of the direction's horizontal part
  Mask live_;
  Real best_t_, best_bundle_, tested_;
  int east_, north_;
};

template <class L, class Samples>
void slice_lanes(const PacketScene& scene, SlicePacket& packet) {
  for (int first = 0; first < packet.count; first += L::kCount) {
    LaneSlicer<L, Samples> slicer(scene, packet, first);
    slicer.run();
    slicer.store(packet, first);
  }
}

template <class L>
void slice_packet_of(const PacketScene& scene, SlicePacket& packet) {
  if (scene.heights.samples.codes) {
    slice_lanes<L, terrain::LaneCodes<L>>(scene, packet);
  } else {
    slice_lanes<L, terrain::LaneFloats<L>>(scene, packet);
  }
}

#undef PLUMB_INLINE

}  // namespace
}  // namespace plumb::slicing
