#include "reference/beam_start.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace plumb::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFewRoundings = 1e-14;  // relative; 45 units in the last place

struct Span {
  double first, last;
  bool empty() const { return !(first <= last); }
};

// Cuts `t` to where some ray of the beam, along one axis, lies between low and high: where
// origin + t * fastest >= low and origin + t * slowest <= high.
void cut(Span& t, double origin, double slowest, double fastest, double low, double high) {
  const auto need = [&](double speed, double way) {  // speed * t >= way
    if (speed > 0.0) {
      t.first = std::max(t.first, way / speed);
    } else if (speed < 0.0) {
      t.last = std::min(t.last, way / speed);
    } else if (way > 0.0) {
      t.last = -kInfinity;
    }
  };
  need(fastest, low - origin);
  need(-slowest, origin - high);
}

// A beam in units of cells, as the walks have it.
struct Thick {
  double u, v, z;
  glm::dvec3 low, high;
  Span t;
  WalkLimits limits;

  // Where the beam may meet what is in the node; empty if nowhere.
  Span within(const HeightPyramid& pyramid, int level, int i, int j) const {
    const double side = static_cast<double>(std::int64_t{1} << level);
    Span span = t;
    cut(span, u, low.x, high.x, i * side - limits.place_slack, (i + 1) * side + limits.place_slack);
    cut(span, v, low.y, high.y, j * side - limits.place_slack, (j + 1) * side + limits.place_slack);
    if (span.empty()) return span;
    span = {span.first * (1.0 - kFewRoundings), span.last * (1.0 + kFewRoundings)};
    const HeightRange range = pyramid.node(level, i, j);
    const double lowest = z + std::min(span.first * low.z, span.last * low.z);
    const double highest = z + std::max(span.first * high.z, span.last * high.z);
    const bool passes = range.empty() || lowest - 2.0 * limits.height_slack > range.high ||
                        highest + 2.0 * limits.height_slack < range.low;
    return passes ? Span{kInfinity, -kInfinity} : span;
  }
  double width_at(double at) const { return at * std::max(high.x - low.x, high.y - low.y); }
};

struct Node {
  int level, i, j;
  double t;
};

Thick thick_ray(const terrain::Heightfield& field, const HeightPyramid& pyramid, const Beam& beam) {
  const glm::dvec3 scale{1.0 / field.dx_m, 1.0 / field.dy_m, 1.0};
  const auto widened = [](const glm::dvec3& v, double sign) {
    return v + sign * kFewRoundings * glm::dvec3(std::abs(v.x), std::abs(v.y), std::abs(v.z));
  };
  return {beam.origin_m.x / field.dx_m,
          beam.origin_m.y / field.dy_m,
          beam.origin_m.z,
          widened(beam.low * scale, -1.0),
          widened(beam.high * scale, 1.0),
          {beam.t_min, beam.t_max},
          walk_limits(field, pyramid, beam.origin_m)};
}

}  // namespace

Beam camera_beam(const Camera& camera, const glm::dvec3& origin_m, double x0, double y0, double x1,
                 double y1) {
  // Directions are linear in the point's place: the corners bound them.
  const glm::dvec3 first = ray_direction(camera, x0, y0);
  Beam beam{camera.eye_m - origin_m, first, first, camera.near_m, camera.far_m};
  for (const double y : {y0, y1}) {
    for (const double x : {x0, x1}) {
      const glm::dvec3 direction = ray_direction(camera, x, y);
      beam.low = glm::min(beam.low, direction);
      beam.high = glm::max(beam.high, direction);
    }
  }
  // More than the roundings of a direction's three sums.
  const double slack = 1e-15;
  beam.low -= slack * (glm::abs(beam.low) + glm::abs(camera.forward) + 1.0);
  beam.high += slack * (glm::abs(beam.high) + glm::abs(camera.forward) + 1.0);
  return beam;
}

BeamStart beam_start(const terrain::Heightfield& field, const HeightPyramid& pyramid,
                     const Beam& beam) {
  BeamStart best{kInfinity, 1};
  const Thick ray = thick_ray(field, pyramid, beam);
  std::array<Node, 4 * 32> stack;
  std::size_t count = 0;
  const auto look_at = [&](int level, int i, int j) {
    if (i >= pyramid.columns(level) || j >= pyramid.rows(level)) return;
    const Span span = ray.within(pyramid, level, i, j);
    if (span.empty() || span.first >= best.t) return;
    const double side = static_cast<double>(std::int64_t{1} << level);
    if (level == 1 || side <= ray.width_at(span.first)) {
      best = {span.first, level};
    } else {
      stack[count++] = {level, i, j, span.first};
    }
  };
  look_at(pyramid.top_level(), 0, 0);
  const int near_i = ray.low.x + ray.high.x >= 0.0 ? 0 : 1;
  const int near_j = ray.low.y + ray.high.y >= 0.0 ? 0 : 1;
  while (count > 0) {
    const Node node = stack[--count];
    if (node.t >= best.t) continue;
    const int level = node.level - 1;
    const int near_x = 2 * node.i + near_i, far_x = 2 * node.i + 1 - near_i;
    const int near_y = 2 * node.j + near_j, far_y = 2 * node.j + 1 - near_j;
    look_at(level, far_x, far_y);
    look_at(level, near_x, far_y);
    look_at(level, far_x, near_y);
    look_at(level, near_x, near_y);
  }
  return best;
}

}  // namespace plumb::reference
