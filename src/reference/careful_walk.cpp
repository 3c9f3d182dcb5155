#include "reference/careful_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reference/careful_cell.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Node {
  int level, i, j;
};

// True if the ray passes over, under or outside everything in the node; then it also says on which
// side.
bool passes_by(CarefulRay& walk, const HeightRange& range, const Interval& t) {
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
void descend(CarefulRay& walk, const Heightfield& field, Diagonal diagonal,
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
    if (!(t.low <= t.high + slack) || t.low > walk.best.t + slack || t.high < walk.t_from) continue;
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
void cut_to_heights(CarefulRay& walk, const WalkLimits& limits) {
  if (walk.dz == 0.0) {
    if (walk.z < limits.lowest || walk.z > limits.highest) walk.t_max = -kInfinity;
    return;
  }
  const double a = (limits.lowest - walk.z) / walk.dz, b = (limits.highest - walk.z) / walk.dz;
  // Widened by the roundings of the division and of the point's height at that t.
  const double slack = 8.0 * kEpsilon * std::max(std::abs(a), std::abs(b));
  walk.t_min = std::max(walk.t_min, std::min(a, b) - slack);
  walk.t_max = std::min(walk.t_max, std::max(a, b) + slack);
}

}  // namespace

WalkLimits walk_limits(const Heightfield& field, const HeightPyramid& pyramid,
                       const glm::dvec3& origin_m) {
  const double low = pyramid.root().low, high = pyramid.root().high;
  const double u = origin_m.x / field.dx_m, v = origin_m.y / field.dy_m;
  WalkLimits limits;
  // A point's height is rounded twice at magnitudes up to |z| + |heights|; a height between samples
  // four times.
  limits.height_slack =
      16.0 * kEpsilon * (std::abs(origin_m.z) + std::max(std::abs(low), std::abs(high)));
  limits.place_slack =
      16.0 * kEpsilon * (std::abs(u) + std::abs(v) + field.columns() + field.rows());
  const double clear = limits.height_slack + (high - low + 1.0) / 16.0;
  limits.lowest = low - clear;
  limits.highest = high + clear;
  return limits;
}

RayHit walk_carefully(const Heightfield& field, Diagonal diagonal, const HeightPyramid& pyramid,
                      const Ray& ray, double t_from) {
  if (pyramid.root().empty()) return {};
  const WalkLimits limits = walk_limits(field, pyramid, ray.origin_m);
  CarefulRay walk;
  walk.u = ray.origin_m.x / field.dx_m;
  walk.v = ray.origin_m.y / field.dy_m;
  walk.z = ray.origin_m.z;
  walk.du = ray.direction.x / field.dx_m;
  walk.dv = ray.direction.y / field.dy_m;
  walk.dz = ray.direction.z;
  const double most = std::max({std::abs(walk.du), std::abs(walk.dv), std::abs(walk.dz)});
  if (std::abs(walk.du) < kStillDirection * most) walk.du = 0.0;
  if (std::abs(walk.dv) < kStillDirection * most) walk.dv = 0.0;
  walk.inverse_du = 1.0 / walk.du;
  walk.inverse_dv = 1.0 / walk.dv;
  walk.ray = ray;
  walk.place_slack = limits.place_slack;
  walk.height_slack = limits.height_slack;
  walk.t_min = ray.t_min;
  walk.t_max = ray.t_max;
  walk.t_from = t_from;
  cut_to_heights(walk, limits);
  if (!(walk.t_min <= walk.t_max)) return {};
  descend(walk, field, diagonal, pyramid);
  return walk.best;
}

}  // namespace plumb::reference
