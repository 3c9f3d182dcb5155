#include "reference/careful_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reference/closed_triangle.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Height of a cell's triangle over cell coordinates (a, b) in [0, 1]^2: base + a * across + b * up.
// NaN if a corner is void.
struct Plane {
  double base, across, up;
  double at(double a, double b) const { return base + (a * across + b * up); }
  bool exists() const { return !std::isnan(base + across + up); }
};

struct Cell {
  std::array<Plane, 2> half;
  bool north_east;  // cut from south-west to north-east

  Cell(const Heightfield& field, Diagonal diagonal, int i, int j)
      : north_east(rises_north_east(diagonal, i, j)) {
    const double sw = field.heights_m(i, j), se = field.heights_m(i + 1, j);
    const double nw = field.heights_m(i, j + 1), ne = field.heights_m(i + 1, j + 1);
    if (north_east) {
      half[0] = {sw, se - sw, ne - se};
      half[1] = {sw, ne - nw, nw - sw};
    } else {
      half[0] = {sw, se - sw, nw - sw};
      half[1] = {nw - (ne - se), ne - nw, ne - se};
    }
  }
  // Positive inside half 0's side of the diagonal, negative inside half 1's.
  double side_of_diagonal(double a, double b) const { return north_east ? a - b : 1.0 - (a + b); }
};

// The ray within one triangle, over t in [from, to].
void meet_triangle(CarefulRay& walk, const Plane& plane, int i, int j, double from, double to,
                   std::uint32_t triangle) {
  if (!plane.exists()) {
    walk.side = 0;
    return;
  }
  const auto above = [&](double t) {
    return (walk.z + t * walk.dz) -
           plane.at((walk.u + t * walk.du) - i, (walk.v + t * walk.dv) - j);
  };
  const double g_from = above(from), g_to = above(to);
  const double slack =
      walk.height_slack + walk.place_slack * (std::abs(plane.across) + std::abs(plane.up));
  if (std::abs(g_from) <= slack || std::abs(g_to) <= slack) walk.uncertain = true;
  const bool entered_through =
      walk.side_t == from && ((walk.side > 0 && g_from < 0.0) || (walk.side < 0 && g_from > 0.0));
  if (g_from == 0.0 || entered_through) {
    walk.found(from, triangle);
  } else if ((g_from > 0.0) != (g_to > 0.0) || g_to == 0.0) {
    const double t = from + (to - from) * (g_from / (g_from - g_to));
    walk.found(std::clamp(t, from, to), triangle);
  }
  walk.side = g_to > 0.0 ? 1 : g_to < 0.0 ? -1 : 0;
  walk.side_t = to;
}

// The ray through a cell from t.low to t.high, cut in two by the cell's diagonal.
void walk_through(CarefulRay& walk, const Cell& cell, int i, int j, const Interval& t,
                  std::uint32_t first) {
  const auto side = [&](double at) {
    return cell.side_of_diagonal((walk.u + at * walk.du) - i, (walk.v + at * walk.dv) - j);
  };
  const auto meet = [&](int half, double from, double to) {
    meet_triangle(walk, cell.half[static_cast<std::size_t>(half)], i, j, from, to,
                  first + static_cast<std::uint32_t>(half));
  };
  const double d_low = side(t.low), d_high = side(t.high);
  if (std::min(std::abs(d_low), std::abs(d_high)) <= walk.place_slack) walk.uncertain = true;
  if ((d_low >= 0.0 && d_high >= 0.0) || (d_low <= 0.0 && d_high <= 0.0)) {
    meet(d_low + d_high >= 0.0 ? 0 : 1, t.low, t.high);
    return;
  }
  const double cut =
      std::clamp(t.low + (t.high - t.low) * (d_low / (d_low - d_high)), t.low, t.high);
  const int first_half = d_low > 0.0 ? 0 : 1;
  meet(first_half, t.low, cut);
  meet(1 - first_half, cut, t.high);
}

// Both triangles as closed sets, without the walk's roundings.
void touch(CarefulRay& walk, const Heightfield& field, bool north_east, int i, int j,
           std::uint32_t first) {
  const auto corner = [&](int a, int b) {
    return glm::dvec3((i + a) * field.dx_m, (j + b) * field.dy_m, field.heights_m(i + a, j + b)) -
           walk.ray.origin_m;
  };
  const glm::dvec3 sw = corner(0, 0), se = corner(1, 0), nw = corner(0, 1), ne = corner(1, 1);
  const auto test = [&](int half, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    if (std::isnan(a.z + b.z + c.z)) return;
    const double t =
        meet_closed_triangle(walk.ray.direction, a, b, c, walk.ray.t_min, walk.ray.t_max);
    if (t < kInfinity) walk.found(t, first + static_cast<std::uint32_t>(half));
  };
  test(0, sw, se, north_east ? ne : nw);
  test(1, north_east ? sw : se, ne, nw);
}

}  // namespace

void meet_cell(CarefulRay& walk, const Heightfield& field, Diagonal diagonal, int i, int j) {
  const Interval t = walk.inside(i, j, i + 1, j + 1);
  const double slack = t_slack(t);
  if (!(t.low <= t.high + slack) || t.low > walk.best.t + slack || t.high < walk.t_from) return;
  const Cell cell(field, diagonal, i, j);
  const std::uint32_t first = terrain::triangle_index(field.cell_columns(), i, j, 0);
  const RayHit before = walk.best;
  const int side_before = walk.side_t == t.low ? walk.side : 0;
  walk.uncertain = t.high - t.low <= slack;
  if (t.low <= t.high) walk_through(walk, cell, i, j, t, first);
  if (!walk.uncertain) return;
  // Where rounding could decide, the triangles as closed sets do. Should they let a ray through
  // that changed sides, what the walk found stands: nothing passes the surface unseen.
  const RayHit walked = std::exchange(walk.best, before);
  touch(walk, field, cell.north_east, i, j, first);
  if (walk.best == before && side_before != 0 && walk.side == -side_before) walk.best = walked;
}

}  // namespace plumb::reference
