// A ray against a closed triangle by signed volumes: for the rays on which a walk through cells
// cannot decide.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>

namespace plumb::reference {

/// First parameter t in [t_min, t_max] of origin + t * direction inside the closed triangle, its
/// corners given relative to the origin; +inf if there is none.
///
///   (1) Exact wherever the products are: corners and direction of few digits, through corners,
///   along edges, in the plane. (2) Two triangles that share an edge agree on which side of it the
///   ray passes, to the bit.
inline double meet_closed_triangle(const glm::dvec3& direction, const glm::dvec3& a,
                                   const glm::dvec3& b, const glm::dvec3& c, double t_min,
                                   double t_max) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const auto volume = [&](const glm::dvec3& p, const glm::dvec3& q) {
    return direction.x * (p.y * q.z - p.z * q.y) + direction.y * (p.z * q.x - p.x * q.z) +
           direction.z * (p.x * q.y - p.y * q.x);
  };
  const double ab = volume(a, b), bc = volume(b, c), ca = volume(c, a);
  if (!((ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0)))
    return kMiss;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = glm::dot(normal, direction);
  double first = kMiss, last = -kMiss;
  if (facing != 0.0) {
    first = last = glm::dot(normal, a) / facing;
  } else {
    // In the triangle's plane: the line's common points with the edges bound what it shares with
    // the triangle.
    const auto add = [&](double t) {
      first = std::min(first, t);
      last = std::max(last, t);
    };
    const auto add_edge = [&](const glm::dvec3& p, const glm::dvec3& q) {
      const glm::dvec3 along = q - p, across = glm::cross(direction, along);
      const double scale = glm::dot(across, across);
      const glm::dvec3 off = glm::cross(p, direction);
      if (scale == 0.0) {
        if (glm::dot(off, off) > 0.0) return;
        add(glm::dot(p, direction) / glm::dot(direction, direction));
        add(glm::dot(q, direction) / glm::dot(direction, direction));
        return;
      }
      const double share = glm::dot(off, across);
      if (share >= 0.0 && share <= scale) add(glm::dot(glm::cross(p, along), across) / scale);
    };
    add_edge(a, b);
    add_edge(b, c);
    add_edge(c, a);
  }
  if (!(first <= last)) return kMiss;
  const double t = std::max(first, t_min);
  return t <= last && t <= t_max ? t : kMiss;
}

}  // namespace plumb::reference
