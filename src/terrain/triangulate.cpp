#include <algorithm>

#include "core/check.h"
#include "terrain/polygon_soup.h"

namespace plumb::terrain {
namespace {

// A polygon's corners, relative to its first one, and its mean normal.
struct Outline {
  std::vector<glm::dvec3> points_m;
  glm::dvec3 normal{0.0};

  Outline(std::span<const std::uint32_t> corners, std::span<const glm::dvec3> vertices_m) {
    for (const std::uint32_t corner : corners)
      points_m.push_back(vertices_m[corner] - vertices_m[corners.front()]);
    for (std::size_t k = 2; k < points_m.size(); ++k)
      normal += area_normal(points_m[0], points_m[k - 1], points_m[k]);
  }

  // Positive where a, b, c turn as the polygon does.
  double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const glm::dvec3 n = area_normal(points_m[a], points_m[b], points_m[c]);
    return n.x * normal.x + n.y * normal.y + n.z * normal.z;
  }
  bool turns_one_way() const {
    const std::size_t size = points_m.size();
    for (std::size_t k = 0; k < size; ++k) {
      if (!(turn(k, (k + 1) % size, (k + 2) % size) > 0.0)) return false;
    }
    return true;
  }
  // Corner `at` of the remaining ones can be cut off: none of the others lies in its triangle.
  bool is_ear(const std::vector<std::size_t>& left, std::size_t at) const {
    const std::size_t a = left[(at + left.size() - 1) % left.size()], b = left[at],
                      c = left[(at + 1) % left.size()];
    if (!(turn(a, b, c) > 0.0)) return false;
    return std::none_of(left.begin(), left.end(), [&](std::size_t p) {
      const bool is_corner = p == a || p == b || p == c || points_m[p] == points_m[a] ||
                             points_m[p] == points_m[b] || points_m[p] == points_m[c];
      return !is_corner && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    });
  }
};

}  // namespace

void triangulate(std::span<const std::uint32_t> corners, std::span<const glm::dvec3> vertices_m,
                 std::vector<Triangle>& triangles) {
  require(corners.size() >= 3, "a polygon has at least three corners, got {}", corners.size());
  if (corners.size() == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const Outline outline(corners, vertices_m);
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < corners.size(); ++k) left.push_back(k);
  if (!outline.turns_one_way()) {
    require(corners.size() <= kMostUnevenCorners,
            "a polygon that is not convex may have {} corners, got {}", kMostUnevenCorners,
            corners.size());
    for (std::size_t at = 0; left.size() > 3 && at < left.size();) {
      if (!outline.is_ear(left, at)) {
        ++at;
        continue;
      }
      triangles.push_back({corners[left[(at + left.size() - 1) % left.size()]], corners[left[at]],
                           corners[left[(at + 1) % left.size()]]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
      at = 0;
    }
  }
  for (std::size_t k = 2; k < left.size(); ++k)
    triangles.push_back({corners[left[0]], corners[left[k - 1]], corners[left[k]]});
}

}  // namespace plumb::terrain
