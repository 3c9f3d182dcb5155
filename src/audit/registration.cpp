#include "audit/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "audit/drawn_point.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

struct Sums {
  double count = 0.0;
  glm::dvec2 shift{0.0};
  double largest_shift = 0.0, largest_off = 0.0, reach = 0.0;
  // Normal equations of n . offset = -distance: the upper triangle of sum n n^T, and sum n *
  // -distance.
  std::array<double, 6> matrix{};
  glm::dvec3 right{0.0};

  void add_shift(const glm::dvec2& each) {
    count += 1.0;
    shift += each;
    largest_shift = std::max(largest_shift, std::sqrt(glm::dot(each, each)));
  }
  void add_plane(const glm::dvec3& normal, double distance) {
    largest_off = std::max(largest_off, std::abs(distance));
    const std::array<double, 6> products{normal.x * normal.x, normal.x * normal.y,
                                         normal.x * normal.z, normal.y * normal.y,
                                         normal.y * normal.z, normal.z * normal.z};
    for (std::size_t k = 0; k < 6; ++k) matrix[k] += products[k];
    right += -distance * normal;
  }
};

Sums joined(Sums a, const Sums& b) {
  a.count += b.count;
  a.shift += b.shift;
  a.largest_shift = std::max(a.largest_shift, b.largest_shift);
  a.largest_off = std::max(a.largest_off, b.largest_off);
  a.reach = std::max(a.reach, b.reach);
  for (std::size_t k = 0; k < 6; ++k) a.matrix[k] += b.matrix[k];
  a.right += b.right;
  return a;
}

double determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

// The offset by Cramer's rule; a little on the diagonal keeps directions that no triangle shows at
// zero.
glm::dvec3 solve(const Sums& s) {
  const double keep = 1e-9 * (s.matrix[0] + s.matrix[3] + s.matrix[5]);
  if (!(keep > 0.0)) return glm::dvec3(0.0);
  const glm::dvec3 x{s.matrix[0] + keep, s.matrix[1], s.matrix[2]},
      y{s.matrix[1], s.matrix[3] + keep, s.matrix[4]},
      z{s.matrix[2], s.matrix[4], s.matrix[5] + keep};
  const double all = determinant(x, y, z);
  return {determinant(s.right, y, z) / all, determinant(x, s.right, z) / all,
          determinant(x, y, s.right) / all};
}

}  // namespace

Registration registration_of(const TriangleMesh* mesh, const HitImage& drawn,
                             const Camera& camera) {
  const glm::dvec3 eye = camera.eye_m - (mesh != nullptr ? mesh->origin_m : camera.eye_m);
  const auto add_pixel = [&](std::size_t pixel, Sums& sums) {
    if (!drawn.hit(pixel)) return;
    const glm::dvec3& ray = drawn.from_eye_m[pixel];
    const glm::dvec3 view{glm::dot(ray, camera.right), glm::dot(ray, camera.up),
                          glm::dot(ray, camera.forward)};
    const auto x = static_cast<double>(pixel % static_cast<std::size_t>(drawn.width_px));
    const auto y = static_cast<double>(pixel / static_cast<std::size_t>(drawn.width_px));
    sums.add_shift(view_to_pixel(camera, view) - glm::dvec2(x + 0.5, y + 0.5));
    if (mesh == nullptr) return;
    const Triangle& t = mesh->triangles[drawn.primitive[pixel]];
    const glm::dvec3 a = mesh->vertices_m[t[0]], b = mesh->vertices_m[t[1]],
                     c = mesh->vertices_m[t[2]];
    glm::dvec3 normal = area_normal(a, b, c);
    const double length = std::sqrt(glm::dot(normal, normal));
    if (length > 0.0) normal /= length;  // a triangle without area has no plane to be off
    sums.add_plane(normal, glm::dot(normal, (eye - a) + ray));
    sums.reach = std::max({sums.reach, largest_coordinate(a), largest_coordinate(ray)});
  };
  const Sums sums = parallel_ordered_reduce(
      static_cast<std::int64_t>(drawn.size()), 4096, Sums{},
      [&](std::int64_t begin, std::int64_t end, Sums s) {
        for (std::int64_t k = begin; k < end; ++k) add_pixel(static_cast<std::size_t>(k), s);
        return s;
      },
      joined);
  Registration r;
  if (sums.count == 0.0) return r;
  r.mean_shift_px = sums.shift / sums.count;
  r.largest_shift_px = sums.largest_shift;
  r.largest_off_plane_m = sums.largest_off;
  // Points, corners and the eye are each rounded at their magnitude, a few times over; thin
  // triangles have normals that are off by as much again.
  r.allowed_off_plane_m = 256.0 * std::numeric_limits<double>::epsilon() *
                          std::max({1.0, sums.reach, largest_coordinate(eye)});
  r.eye_offset_m = solve(sums);
  r.agrees = r.largest_shift_px <= kSnapShiftPx && r.largest_off_plane_m <= r.allowed_off_plane_m;
  return r;
}

}  // namespace plumb::audit
