#include "reference/pyramid_caster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "reference/closed_triangle.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kTile = 32;  // pixels along the side of a piece of work

// A direction component so small that a ray of it crosses no cell within any terrain: 1e-30 cells a
// unit of t.
constexpr double kStill = 1e-30;

struct Interval {
  double low, high;
};

// A ray in units of cells across and up and metres of height, with what the walk has found so far.
struct Walk {
  double u, v, z;     // origin
  double du, dv, dz;  // direction
  double inverse_du, inverse_dv;
  double t_min, t_max;
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
  double side_t = -kInfinity;

  // Where the ray is between the grid lines `low` and `high`; the same line gives the same t for
  // all cells that share it.
  static Interval between_lines(double origin, double step, double inverse, int low, int high) {
    if (step == 0.0)
      return low <= origin && origin <= high ? Interval{-kInfinity, kInfinity}
                                             : Interval{kInfinity, -kInfinity};
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
void meet_triangle(Walk& walk, const Plane& plane, int i, int j, double from, double to,
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

// More than the roundings of two divisions by which grid lines are met.
double t_slack(const Interval& t) {
  return 8.0 * kEpsilon * std::max(std::abs(t.low), std::abs(t.high));
}

// The ray through a cell from t.low to t.high, cut in two by the cell's diagonal.
void walk_through(Walk& walk, const Cell& cell, int i, int j, const Interval& t,
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
void touch(Walk& walk, const Heightfield& field, bool north_east, int i, int j,
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

void meet_cell(Walk& walk, const Heightfield& field, Diagonal diagonal, int i, int j) {
  const Interval t = walk.inside(i, j, i + 1, j + 1);
  const double slack = t_slack(t);
  if (!(t.low <= t.high + slack) || t.low > walk.best.t + slack) return;
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

struct Node {
  int level, i, j;
};

// True if the ray passes over, under or outside everything in the node; then it also says on which
// side.
bool passes_by(Walk& walk, const HeightRange& range, const Interval& t) {
  if (range.empty()) {
    walk.side = 0;
    return true;
  }
  const double z_low = walk.z + t.low * walk.dz, z_high = walk.z + t.high * walk.dz;
  const bool over = std::min(z_low, z_high) - walk.height_slack > range.high;
  const bool under = std::max(z_low, z_high) + walk.height_slack < range.low;
  if (!over && !under) return false;
  walk.side = over ? 1 : -1;
  walk.side_t = t.high;
  return true;
}

// Depth first, the children that the ray meets first before the others.
void descend(Walk& walk, const Heightfield& field, Diagonal diagonal,
             const HeightPyramid& pyramid) {
  std::array<Node, 4 * 32> stack;
  int count = 0;
  stack[static_cast<std::size_t>(count++)] = {pyramid.top_level(), 0, 0};
  const int near_i = walk.du >= 0.0 ? 0 : 1, near_j = walk.dv >= 0.0 ? 0 : 1;
  while (count > 0) {
    const Node node = stack[static_cast<std::size_t>(--count)];
    if (node.level == 0) {
      meet_cell(walk, field, diagonal, node.i, node.j);
      continue;
    }
    const int i1 = std::min((node.i + 1) << node.level, field.cell_columns());
    const int j1 = std::min((node.j + 1) << node.level, field.cell_rows());
    const Interval t = walk.inside(node.i << node.level, node.j << node.level, i1, j1);
    const double slack = t_slack(t);
    if (!(t.low <= t.high + slack) || t.low > walk.best.t + slack) continue;
    if (passes_by(walk, pyramid.node(node.level, node.i, node.j), t)) continue;
    const int level = node.level - 1;
    const int columns = level > 0 ? pyramid.columns(level) : field.cell_columns();
    const int rows = level > 0 ? pyramid.rows(level) : field.cell_rows();
    const int last_i = 2 * node.i + (1 - near_i), first_i = 2 * node.i + near_i;
    const int last_j = 2 * node.j + (1 - near_j), first_j = 2 * node.j + near_j;
    const auto push = [&](int i, int j) {
      if (i < columns && j < rows) stack[static_cast<std::size_t>(count++)] = {level, i, j};
    };
    push(last_i, last_j);
    push(first_i, last_j);
    push(last_i, first_j);
    push(first_i, first_j);
  }
}

// Cuts the ray to the slab of heights where the surface is; finite, since a ray that moves over no
// cell moves up or down.
void cut_to_heights(Walk& walk, const HeightRange& range) {
  const double low = range.low - walk.height_slack, high = range.high + walk.height_slack;
  if (walk.dz == 0.0) {
    if (walk.z < low || walk.z > high) walk.t_max = -kInfinity;
    return;
  }
  const double a = (low - walk.z) / walk.dz, b = (high - walk.z) / walk.dz;
  // Widened by the roundings of the division and of the point's height at that t.
  const double slack = 8.0 * kEpsilon * std::max(std::abs(a), std::abs(b));
  walk.t_min = std::max(walk.t_min, std::min(a, b) - slack);
  walk.t_max = std::min(walk.t_max, std::max(a, b) + slack);
}

RayHit cast_ray(const Heightfield& field, Diagonal diagonal, const HeightPyramid& pyramid,
                const Ray& ray) {
  const HeightRange& root = pyramid.root();
  if (root.empty()) return {};
  Walk walk;
  walk.u = ray.origin_m.x / field.dx_m;
  walk.v = ray.origin_m.y / field.dy_m;
  walk.z = ray.origin_m.z;
  walk.du = ray.direction.x / field.dx_m;
  walk.dv = ray.direction.y / field.dy_m;
  walk.dz = ray.direction.z;
  const double most = std::max({std::abs(walk.du), std::abs(walk.dv), std::abs(walk.dz)});
  if (std::abs(walk.du) < kStill * most) walk.du = 0.0;
  if (std::abs(walk.dv) < kStill * most) walk.dv = 0.0;
  walk.inverse_du = 1.0 / walk.du;
  walk.inverse_dv = 1.0 / walk.dv;
  walk.ray = ray;
  walk.place_slack =
      16.0 * kEpsilon * (std::abs(walk.u) + std::abs(walk.v) + field.columns() + field.rows());
  walk.t_min = ray.t_min;
  walk.t_max = ray.t_max;
  // A point's height is rounded twice at magnitudes up to |z| + |heights|; a height between samples
  // four times.
  const double largest =
      std::max(std::abs(static_cast<double>(root.low)), std::abs(static_cast<double>(root.high)));
  walk.height_slack = 16.0 * kEpsilon * (std::abs(walk.z) + largest);
  cut_to_heights(walk, root);
  if (!(walk.t_min <= walk.t_max)) return {};
  descend(walk, field, diagonal, pyramid);
  return walk.best;
}

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

PyramidCaster::PyramidCaster(const Heightfield& field, Diagonal diagonal)
    : field_(field), diagonal_(diagonal), pyramid_((terrain::require_valid(field), field)) {}

RayHit PyramidCaster::cast(const Ray& ray) const {
  require(finite(ray.origin_m) && finite(ray.direction),
          "a ray's origin and direction must be finite");
  require(glm::dot(ray.direction, ray.direction) > 0.0, "a ray's direction must not be zero");
  require(ray.t_min >= 0.0, "t_min must be >= 0, got {}", ray.t_min);
  return cast_ray(field_, diagonal_, pyramid_, ray);
}

Ray PyramidCaster::camera_ray(const Camera& camera, double x_px, double y_px) const {
  return {camera.eye_m - field_.world_origin_m(), ray_direction(camera, x_px, y_px), camera.near_m,
          camera.far_m};
}

HitImage PyramidCaster::cast_frame(const Camera& camera) const {
  HitImage image(camera.width_px, camera.height_px);
  const int tiles_x = (camera.width_px + kTile - 1) / kTile,
            tiles_y = (camera.height_px + kTile - 1) / kTile;
  parallel_for(static_cast<std::int64_t>(tiles_x) * tiles_y, 1, [&](std::int64_t tile) {
    const int x0 = static_cast<int>(tile % tiles_x) * kTile,
              y0 = static_cast<int>(tile / tiles_x) * kTile;
    for (int y = y0; y < std::min(y0 + kTile, camera.height_px); ++y) {
      for (int x = x0; x < std::min(x0 + kTile, camera.width_px); ++x) {
        const Ray ray = camera_ray(camera, x + 0.5, y + 0.5);
        const RayHit hit = cast_ray(field_, diagonal_, pyramid_, ray);
        if (!hit) continue;
        const std::size_t pixel = image.index(x, y);
        image.depth_m[pixel] = hit.t;
        image.from_eye_m[pixel] = hit.t * ray.direction;
        image.primitive[pixel] = hit.triangle;
      }
    }
  });
  return image;
}

}  // namespace plumb::reference
