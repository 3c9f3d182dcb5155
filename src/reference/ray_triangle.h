// Where a ray meets a triangle, in double, with no gap between triangles that share an edge.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "reference/ray.h"

namespace plumb::reference {

/// A point in the ray's own coordinates: the ray is the line u = v = 0, and t is its parameter
/// there.
struct RayPoint {
  double u, v, t;
};

/// The affine map to a ray's coordinates: the ray's origin goes to zero, its longest axis becomes
/// t, and the other two are sheared until the ray has none of them.
class RayFrame {
 public:
  explicit RayFrame(const Ray& ray) : origin_(ray.origin_m) {
    const glm::dvec3 size(std::abs(ray.direction.x), std::abs(ray.direction.y),
                          std::abs(ray.direction.z));
    along_ = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    across_ = (along_ + 1) % 3;
    up_ = (along_ + 2) % 3;
    shear_u_ = ray.direction[across_] / ray.direction[along_];
    shear_v_ = ray.direction[up_] / ray.direction[along_];
    scale_t_ = 1.0 / ray.direction[along_];
    inverse_x_ = finite_inverse(ray.direction.x);
    inverse_y_ = finite_inverse(ray.direction.y);
  }

  const glm::dvec3& origin_m() const { return origin_; }
  /// `from_origin` is a point less origin_m(). A point is mapped in the same way for every triangle
  /// that has it.
  RayPoint place(const glm::dvec3& from_origin) const {
    const double depth = from_origin[along_];
    return {from_origin[across_] - shear_u_ * depth, from_origin[up_] - shear_v_ * depth,
            scale_t_ * depth};
  }

  // The map's numbers, for code that maps many points at once.
  int along() const { return along_; }
  int across() const { return across_; }
  int up() const { return up_; }
  double shear_u() const { return shear_u_; }
  double shear_v() const { return shear_v_; }
  double scale_t() const { return scale_t_; }

  /// False if no point of the ray lies over the rectangle [low, high] of the map, given less
  /// origin_m(). True for some that miss it by a rounding.
  bool passes_over(const glm::dvec2& low, const glm::dvec2& high) const {
    const double west = low.x * inverse_x_, east = high.x * inverse_x_;
    const double south = low.y * inverse_y_, north = high.y * inverse_y_;
    const bool before = std::max(west, east) < std::min(south, north);
    const bool after = std::max(south, north) < std::min(west, east);
    return !before && !after;
  }

 private:
  // Finite, so that no product with it is not a number.
  static double finite_inverse(double x) { return std::abs(x) > 1e-300 ? 1.0 / x : 1e300; }

  glm::dvec3 origin_;
  int along_, across_, up_;
  double shear_u_, shear_v_, scale_t_, inverse_x_, inverse_y_;
};

namespace detail {

// Twice the area of (0, a, b). Exactly antisymmetric; and since rounding is monotonic, never of the
// wrong sign: at worst zero.
inline double side_of(const RayPoint& a, const RayPoint& b) { return a.u * b.v - a.v * b.u; }

// How far beyond an edge's end, in lengths of the edge, rounding may put a ray that meets the end
// exactly: sheared coordinates are off by 2^-52 of the corner's distance, and an edge is longer
// than 2^-22 of that where the terrain has at most 2^16 cells a side.
constexpr double kBeyondEnd = 1.0 / (1 << 30);

struct EdgeCrossing {
  double t;
  double outside;  // how far beyond the edge's ends the ray passes, in lengths of the edge
};

// Where the ray crosses an edge whose line it meets. The same bits for (a, b) and (b, a).
inline EdgeCrossing cross_edge(RayPoint a, RayPoint b) {
  if (b.u < a.u || (b.u == a.u && (b.v < a.v || (b.v == a.v && b.t < a.t)))) std::swap(a, b);
  const double du = b.u - a.u, dv = b.v - a.v;
  if (du == 0.0 && dv == 0.0) {  // the edge lies along the ray
    const bool met = a.u == 0.0 && a.v == 0.0;
    return {a.t, met ? 0.0 : std::numeric_limits<double>::infinity()};
  }
  const double s = std::abs(du) >= std::abs(dv) ? -a.u / du : -a.v / dv;
  if (s <= 0.0) return {a.t, -s};
  if (s >= 1.0) return {b.t, s - 1.0};
  return {a.t + s * (b.t - a.t), 0.0};
}

}  // namespace detail

/// Parameter t of the first point with t in [t_min, t_max] that the ray shares with the closed
/// triangle (a, b, c); +inf if it shares none. NaN coordinates share none.
///
///   (1) Watertight: of triangles that surround the ray without a gap at least one is met.
///   (2) Triangles around an edge or corner that the ray crosses are met at the same t, to the bit.
///   (3) A triangle seen edge-on is met where the ray enters it.
/// Source: [Woop, Benthin & Wald 2013, sections 3.1 and 3.2] for the shear; edges and corners are
/// settled here by their own parameter.
inline double meet_triangle(const RayPoint& a, const RayPoint& b, const RayPoint& c, double t_min,
                            double t_max) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const double at_a = detail::side_of(b, c), at_b = detail::side_of(c, a),
               at_c = detail::side_of(a, b);
  const bool left = at_a >= 0.0 && at_b >= 0.0 && at_c >= 0.0;
  const bool right = at_a <= 0.0 && at_b <= 0.0 && at_c <= 0.0;
  if (!left && !right) return kMiss;
  const int edges = (at_a == 0.0) + (at_b == 0.0) + (at_c == 0.0);
  if (edges == 0) {
    const double t = (at_a * a.t + at_b * b.t + at_c * c.t) / (at_a + at_b + at_c);
    return t >= t_min && t <= t_max ? t : kMiss;
  }

  double first = kMiss, last = -kMiss;
  const auto try_edge = [&](const RayPoint& p, const RayPoint& q) {
    const detail::EdgeCrossing crossing = detail::cross_edge(p, q);
    if (edges > 1 && crossing.outside > detail::kBeyondEnd) return;
    first = crossing.t < first ? crossing.t : first;
    last = crossing.t > last ? crossing.t : last;
  };
  if (at_a == 0.0) try_edge(b, c);
  if (at_b == 0.0) try_edge(c, a);
  if (at_c == 0.0) try_edge(a, b);
  const double t = first < t_min && last >= t_min ? t_min : first;
  return t >= t_min && t <= t_max ? t : kMiss;
}

/// Takes what meet_triangle gave for a triangle if it is nearer than `best`, or as near with a
/// lower index.
inline void offer(RayHit& best, double t, std::uint32_t triangle) {
  if (t < best.t || (t == best.t && best && triangle < best.triangle)) best = {t, triangle};
}

}  // namespace plumb::reference
