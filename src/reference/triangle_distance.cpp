#include "reference/triangle_distance.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace plumb::reference {
namespace {

// Barycentric: far more than the roundings of a foot's coordinates.
constexpr double kWellInside = 1e-9;

bool comes_before(const glm::dvec3& a, const glm::dvec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

double squared_distance(const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec3 d = p - q;
  return glm::dot(d, d);
}

}  // namespace

glm::dvec3 nearest_on_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  glm::dvec3 from = a, to = b;
  if (comes_before(to, from)) std::swap(from, to);
  const glm::dvec3 along = to - from;
  const double length_squared = glm::dot(along, along);
  if (!(length_squared > 0.0)) return from;
  const double s = glm::dot(point - from, along) / length_squared;
  if (s <= 0.0) return from;
  if (s >= 1.0) return to;
  return from + s * along;
}

glm::dvec3 nearest_on_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c) {
  // The foot of the perpendicular, a + v * (b - a) + w * (c - a).
  const glm::dvec3 ab = b - a, ac = c - a, ap = point - a;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double area_squared = glm::dot(normal, normal);
  double v = -1.0, w = -1.0;
  if (area_squared > 0.0) {
    v = glm::dot(glm::cross(ap, ac), normal) / area_squared;
    w = glm::dot(glm::cross(ab, ap), normal) / area_squared;
    // Well inside, and nearer than any edge.
    if (std::min({v, w, 1.0 - (v + w)}) > kWellInside) return a + (v * ab + w * ac);
  }

  glm::dvec3 nearest = nearest_on_segment(point, a, b);
  double least = squared_distance(point, nearest);
  const auto offer = [&](const glm::dvec3& q) {
    const double distance = squared_distance(point, q);
    if (distance < least) {
      least = distance;
      nearest = q;
    }
  };
  offer(nearest_on_segment(point, b, c));
  offer(nearest_on_segment(point, c, a));
  if (v > 0.0 && w > 0.0 && v + w < 1.0) offer(a + (v * ab + w * ac));
  return nearest;
}

}  // namespace plumb::reference
