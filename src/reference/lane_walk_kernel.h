// The walk of lane_walk.h, written once for every number of lanes. Included by one file for each
// instruction set, and by nothing else: those files may call no inline function that others share,
// lest the linker give everybody a copy for the newest processor.
#pragma once

#define PLUMB_INLINE __attribute__((always_inline)) inline

#include "reference/lane_heights.h"
#include "reference/lane_ready.h"

namespace plumb::reference {
namespace {

template <class L, class Heights>
class LaneWalker {
  using Real = typename L::Real;
  using Mask = typename L::Mask;

  static constexpr double kTag = 4503599627370496.0;  // 2^52: levels are kept as kTag + level
  // Two sets of rays are under way, so that one computes while the other waits for memory.
  static constexpr int kSets = 2;
  // Lanes that wait before new rays are fetched, and before cells are looked at.
  static constexpr int kRefillAt = L::kCount >= 8 ? 2 : 1;
  static constexpr int kCellsAt = L::kCount >= 8 ? 3 : L::kCount / 2;

  // Rays under way: each lane in a node, entered at t.
  struct Walkers {
    Real du, dv, dz, inverse_du, inverse_dv, end, t_low, ray;
    Real t, x, y, size, level;  // (x, y): the node's south-west corner, in cells; level: + kTag
    Mask alive;
    Mask close;  // in a cell that the ray does not pass over or under: its triangles are to be met

    PLUMB_INLINE Real u_at(Real u) const { return u + t * du; }
    PLUMB_INLINE Real v_at(Real v) const { return v + t * dv; }
  };

  // Where walkers leave their nodes.
  struct Exit {
    Mask east, north;  // the ray moves that way
    Real across, up;   // t at the grid lines ahead
    Real t;
  };

  // A cell's triangle: the height over (a, b) in [0, 1]^2 is base + (a * across + b * up).
  struct Plane {
    Real base, across, up;
    PLUMB_INLINE Real at(Real a, Real b) const { return base + (a * across + b * up); }
  };
  struct Cell {
    Mask rises;  // cut from south-west to north-east
    Plane south_east, north_west;
  };

  // A place on the ray, within a cell.
  struct Place {
    Real t, a, b, z;
  };

  const LaneScene& scene_;
  LaneRays& rays_;
  const Heights heights_{scene_};
  ReadyRays ready_;
  int next_ = 0;
  const Real zero_ = L::all(0.0), half_ = L::all(0.5), one_ = L::all(1.0);
  const Real u_ = L::all(scene_.u), v_ = L::all(scene_.v), z_ = L::all(scene_.z);
  const Real height_slack_ = L::all(scene_.height_slack), place_slack_ = L::all(scene_.place_slack);
  const typename L::Table level_begin_ = L::table(scene_.level_begin);
  const typename L::Table level_row_ = L::table(scene_.level_row);
  const typename L::Table level_column_ = L::table(scene_.level_column);

  PLUMB_INLINE Real between(Real x, Real low, Real high) const {
    return L::least(L::greatest(x, low), high);
  }

  // Gives idle lanes the next rays.
  PLUMB_INLINE void refill(Walkers& w) {
    unsigned idle = ((1u << L::kCount) - 1u) & ~L::bits(w.alive);
    int room = __builtin_popcount(idle);
    if (room < kRefillAt || next_ >= rays_.count) return;
    for (; room > rays_.count - next_; --room) idle &= idle - 1;
    const Mask fresh = L::mask(idle);
    double numbers[L::kCount];
    for (int lane = 0; lane < L::kCount; ++lane) numbers[lane] = next_ + lane;
    w.ray = L::spread(w.ray, fresh, numbers);
    w.du = L::spread(w.du, fresh, ready_.du + next_);
    w.dv = L::spread(w.dv, fresh, ready_.dv + next_);
    w.dz = L::spread(w.dz, fresh, ready_.dz + next_);
    w.inverse_du = L::spread(w.inverse_du, fresh, ready_.inverse_du + next_);
    w.inverse_dv = L::spread(w.inverse_dv, fresh, ready_.inverse_dv + next_);
    w.t = L::spread(w.t, fresh, ready_.begin + next_);
    w.end = L::spread(w.end, fresh, ready_.end + next_);
    w.t_low = L::spread(w.t_low, fresh, ready_.t_low + next_);
    next_ += room;
    const double side = 1 << rays_.begin_level;
    const Real size = L::all(side), inverse = L::all(1.0 / side);
    // Halfway into the last cell, so that a place on the terrain's far border has a node.
    const Real x = between(w.u_at(u_), zero_, L::all(scene_.cell_columns - 0.5));
    const Real y = between(w.v_at(v_), zero_, L::all(scene_.cell_rows - 0.5));
    w.x = L::choose(fresh, L::floor(x * inverse) * size, w.x);
    w.y = L::choose(fresh, L::floor(y * inverse) * size, w.y);
    w.size = L::choose(fresh, size, w.size);
    w.level = L::choose(fresh, L::all(kTag + rays_.begin_level), w.level);
    w.alive = L::either(w.alive, L::both(fresh, L::less_equal(w.t, w.end)));
  }

  PLUMB_INLINE Exit exit_of(const Walkers& w) const {
    Exit exit;
    exit.east = L::less(zero_, w.du);
    exit.north = L::less(zero_, w.dv);
    exit.across = ((w.x + L::choose(exit.east, w.size, zero_)) - u_) * w.inverse_du;
    exit.up = ((w.y + L::choose(exit.north, w.size, zero_)) - v_) * w.inverse_dv;
    exit.t = L::least(L::least(exit.across, exit.up), w.end);
    return exit;
  }

  // Those of `nodes` whose ray stays above or below everything in the node, or that are empty.
  PLUMB_INLINE Mask pass_by(const Walkers& w, const Exit& exit, Mask nodes) const {
    const Real index =
        L::look_up(level_begin_, w.level) +
        (w.y * L::look_up(level_row_, w.level) + w.x * L::look_up(level_column_, w.level));
    const auto range = heights_.range(index, nodes);
    const Real z_in = z_ + w.t * w.dz, z_out = z_ + exit.t * w.dz;
    const Mask over = L::less(range.second, L::least(z_in, z_out) - height_slack_);
    const Mask under = L::less(L::greatest(z_in, z_out) + height_slack_, range.first);
    return L::both(nodes, L::either(over, under));
  }

  // The same of cells, by their four corners. A void compares as nothing.
  PLUMB_INLINE Mask pass_by_cell(const Walkers& w, const Exit& exit, Mask cells) const {
    const Real index = w.y * L::all(scene_.columns) + w.x;
    const auto south = heights_.south(index, cells);
    const auto north = heights_.north(index, cells);
    const Real z_in = z_ + w.t * w.dz, z_out = z_ + exit.t * w.dz;
    const Real lowest = L::least(z_in, z_out) - height_slack_;
    const Real highest = L::greatest(z_in, z_out) + height_slack_;
    const Mask over = L::both(L::both(L::less(south.first, lowest), L::less(south.second, lowest)),
                              L::both(L::less(north.first, lowest), L::less(north.second, lowest)));
    const Mask under =
        L::both(L::both(L::less(highest, south.first), L::less(highest, south.second)),
                L::both(L::less(highest, north.first), L::less(highest, north.second)));
    return L::both(cells, L::either(over, under));
  }

  PLUMB_INLINE Mask rising(Real x, Real y) const {
    if (scene_.cut == LaneScene::Cut::Fixed) return L::mask(0);
    if (scene_.cut == LaneScene::Cut::Alternating) {
      const Real w = (x + y) * half_;
      return L::equal(L::floor(w), w);
    }
    const Real eighth = L::all(0.125), a = x * eighth, b = y * eighth;
    return L::same(L::less(a - L::floor(a), half_), L::less(b - L::floor(b), half_));
  }

  PLUMB_INLINE Cell cell_at(const Walkers& w, Mask cells) const {
    const Real index = w.y * L::all(scene_.columns) + w.x;
    const auto [sw, se] = heights_.south(index, cells);
    const auto [nw, ne] = heights_.north(index, cells);
    const Real south = se - sw, north = ne - nw, west = nw - sw, east = ne - se;
    Cell cell;
    cell.rises = rising(w.x, w.y);
    cell.south_east = {sw, south, L::choose(cell.rises, east, west)};
    cell.north_west = {L::choose(cell.rises, sw, nw - east), north,
                       L::choose(cell.rises, west, east)};
    return cell;
  }

  PLUMB_INLINE Place place_at(const Walkers& w, Real t) const {
    return {t, (u_ + t * w.du) - w.x, (v_ + t * w.dv) - w.y, z_ + t * w.dz};
  }
  // Positive on the south-eastern triangle's side.
  PLUMB_INLINE Real side_of_diagonal(const Cell& cell, const Place& p) const {
    return L::choose(cell.rises, p.a - p.b, one_ - (p.a + p.b));
  }
  PLUMB_INLINE Plane choose(Mask m, const Plane& p, const Plane& q) const {
    return {L::choose(m, p.base, q.base), L::choose(m, p.across, q.across),
            L::choose(m, p.up, q.up)};
  }

  // The ray within one triangle.
  struct Meeting {
    Mask crosses, unsure;
    Real t;
  };
  PLUMB_INLINE Meeting meet(const Plane& plane, const Place& from, const Place& to) const {
    const Real above_from = from.z - plane.at(from.a, from.b),
               above_to = to.z - plane.at(to.a, to.b);
    const Real slack =
        height_slack_ + place_slack_ * (L::magnitude(plane.across) + L::magnitude(plane.up));
    const Real t = from.t + (to.t - from.t) * (above_from / (above_from - above_to));
    return {L::less(above_from * above_to, zero_),
            L::less_equal(L::least(L::magnitude(above_from), L::magnitude(above_to)), slack),
            between(t, from.t, to.t)};
  }

  // Writes down what is found in `cells`. Returns those that are done: with a hit, or undecided.
  PLUMB_INLINE Mask meet_cells(const Walkers& w, const Exit& exit, Mask cells) {
    const Real entry_across = ((w.x + L::choose(exit.east, zero_, one_)) - u_) * w.inverse_du;
    const Real entry_up = ((w.y + L::choose(exit.north, zero_, one_)) - v_) * w.inverse_dv;
    const Cell cell = cell_at(w, cells);
    const Place from = place_at(w, L::greatest(L::greatest(entry_across, entry_up), w.t_low));
    const Place to = place_at(w, exit.t);
    const Real few_roundings =
        L::all(kFewRoundings) * L::greatest(L::magnitude(from.t), L::magnitude(to.t));
    const Real side_from = side_of_diagonal(cell, from), side_to = side_of_diagonal(cell, to);
    const Mask begins_south_east = L::less(zero_, side_from);
    const Mask one_triangle = L::same(begins_south_east, L::less(zero_, side_to));
    const Real cut =
        between(from.t + (to.t - from.t) * (side_from / (side_from - side_to)), from.t, to.t);
    const Place middle = place_at(w, L::choose(one_triangle, to.t, cut));

    const Meeting first =
        meet(choose(begins_south_east, cell.south_east, cell.north_west), from, middle);
    const Meeting second =
        meet(choose(begins_south_east, cell.north_west, cell.south_east), middle, to);
    const Mask hit_second = L::without(L::without(second.crosses, one_triangle), first.crosses);
    const Mask hit = L::either(first.crosses, hit_second);
    const Real t = L::choose(first.crosses, first.t, second.t);

    Mask unsure = L::either(first.unsure, L::without(second.unsure, one_triangle));
    const auto doubt = [&](Real small, Real limit) {
      unsure = L::either(unsure, L::less_equal(small, limit));
    };
    doubt(to.t - from.t, few_roundings);
    doubt(L::magnitude(exit.across - exit.up), few_roundings);
    doubt(L::magnitude(entry_across - entry_up), few_roundings);
    doubt(L::least(L::magnitude(side_from), L::magnitude(side_to)), place_slack_);
    unsure = L::either(unsure, L::both(hit, L::less_equal(to.t - t, few_roundings)));

    const Mask done = L::both(cells, L::either(hit, unsure));
    if (L::bits(done)) {
      const Mask south_east = L::same(first.crosses, begins_south_east);
      // A cell takes no longer than from one grid line to the next: the cell before is seen again.
      const Real cell_before =
          from.t - L::all(2.0) * L::least(L::magnitude(w.inverse_du), L::magnitude(w.inverse_dv));
      write_down(w, done, unsure, L::choose(unsure, cell_before, t),
                 L::choose(south_east, zero_, one_));
    }
    return done;
  }

  void write_down(const Walkers& w, Mask done, Mask unsure, Real t, Real half) {
    const Real number = (w.y * L::all(scene_.columns - 1.0) + w.x) * L::all(2.0) + half;
    double ts[L::kCount], triangles[L::kCount], rays[L::kCount];
    L::store(ts, t);
    L::store(triangles, number);
    L::store(rays, w.ray);
    const unsigned marks = L::bits(unsure);
    for (unsigned left = L::bits(done); left; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const int ray = static_cast<int>(rays[lane]);
      rays_.undecided[ray] = (marks >> lane & 1u) != 0;
      rays_.t[ray] = ts[lane];
      if (rays_.undecided[ray]) continue;
      rays_.triangle[ray] = static_cast<std::uint32_t>(triangles[lane]);
    }
  }

  // Moves `passed` to the node beside, or to its parent if the ray has just entered that; `entered`
  // to the child where the ray is.
  PLUMB_INLINE void move(Walkers& w, const Exit& exit, Mask passed, Mask entered) const {
    const Mask sideways = L::less(exit.across, exit.up);
    const Real step_x = L::choose(exit.east, w.size, zero_ - w.size);
    const Real step_y = L::choose(exit.north, w.size, zero_ - w.size);
    const Real x = L::choose(sideways, w.x + step_x, w.x),
               y = L::choose(sideways, w.y, w.y + step_y);
    const Real twice = w.size + w.size;
    const Real inverse = L::look_up(level_column_, w.level) * half_;
    const Real parent_x = L::floor(x * inverse) * twice, parent_y = L::floor(y * inverse) * twice;
    const Mask new_column = L::same(L::equal(parent_x, x), exit.east);
    const Mask new_row = L::same(L::equal(parent_y, y), exit.north);
    const Mask new_parent = L::either(L::both(sideways, new_column), L::without(new_row, sideways));
    const Mask rises =
        L::both(L::both(passed, new_parent), L::less(w.level, L::all(kTag + scene_.top_level)));

    const Real half = w.size * half_, middle_x = w.x + half, middle_y = w.y + half;
    const Mask beyond_x = L::less_equal((middle_x - u_) * w.inverse_du, w.t);
    const Mask beyond_y = L::less_equal((middle_y - v_) * w.inverse_dv, w.t);
    const Mask eastern = L::both(entered, L::same(beyond_x, exit.east));
    const Mask northern = L::both(entered, L::same(beyond_y, exit.north));

    w.x = L::choose(rises, parent_x, L::choose(passed, x, L::choose(eastern, middle_x, w.x)));
    w.y = L::choose(rises, parent_y, L::choose(passed, y, L::choose(northern, middle_y, w.y)));
    w.t = L::choose(passed, exit.t, w.t);
    w.size = L::choose(rises, twice, L::choose(entered, half, w.size));
    w.level = L::choose(rises, w.level + one_, L::choose(entered, w.level - one_, w.level));
  }

  PLUMB_INLINE void step(Walkers& w) {
    refill(w);
    const unsigned alive = L::bits(w.alive);
    if (!alive) return;
    const Mask in_cell = L::both(w.alive, L::equal(w.level, L::all(kTag)));
    const Mask in_node = L::without(w.alive, in_cell);
    const Exit exit = exit_of(w);
    Mask passed = L::mask(0), entered = L::mask(0), done = L::mask(0);
    if (L::bits(in_node)) {
      passed = pass_by(w, exit, in_node);
      entered = L::without(in_node, passed);
    }
    const Mask fresh = L::without(in_cell, w.close);
    if (L::bits(fresh)) {
      const Mask clear = pass_by_cell(w, exit, fresh);
      passed = L::either(passed, clear);
      w.close = L::either(w.close, L::without(fresh, clear));
    }
    const Mask close = L::both(in_cell, w.close);
    if (__builtin_popcount(L::bits(close)) >= kCellsAt || !L::bits(L::either(passed, entered))) {
      done = meet_cells(w, exit, close);
      passed = L::either(passed, L::without(close, done));
      w.close = L::without(w.close, close);
    }
    done = L::either(done, L::both(passed, L::less_equal(w.end, exit.t)));
    move(w, exit, passed, entered);
    w.alive = L::without(w.alive, done);
  }

 public:
  LaneWalker(const LaneScene& scene, LaneRays& rays) : scene_(scene), rays_(rays) {}

  void run() {
    for (int k = 0; k < rays_.count; k += L::kCount) make_ready<L>(scene_, rays_, ready_, k);
    Walkers sets[kSets];
    for (Walkers& w : sets) {
      w.du = w.dv = w.dz = w.inverse_du = w.inverse_dv = w.end = w.t_low = w.ray = zero_;
      w.t = w.x = w.y = zero_;
      w.size = one_;
      w.level = L::all(kTag);
      w.alive = w.close = L::mask(0);
    }
    for (unsigned alive = 1; alive || next_ < rays_.count;) {
      alive = 0;
      for (Walkers& w : sets) {
        step(w);
        alive |= L::bits(w.alive);
      }
    }
  }
};

template <class L>
void walk_in_lanes(const LaneScene& scene, LaneRays& rays) {
  if (scene.heights.codes) {
    LaneWalker<L, WalkCodes<L>>(scene, rays).run();
  } else {
    LaneWalker<L, WalkFloats<L>>(scene, rays).run();
  }
}

#undef PLUMB_INLINE

}  // namespace
}  // namespace plumb::reference
