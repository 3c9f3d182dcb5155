#include "reference/mesh_nearest.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "reference/box_tree.h"
#include "reference/mesh_triangles.h"
#include "reference/triangle_distance.h"

namespace plumb::reference {
namespace {

double sum(const glm::dvec3& a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

// True only if the triangle's plane lies farther than `radius` from the origin, whatever the
// roundings: a cross product is off by less than kRoundings of its factors' lengths, and the
// triangle may be a needle.
bool plane_is_beyond(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double radius) {
  constexpr double kRoundings = 1e-15, kRelative = 1e-9;
  const glm::dvec3 ab = b - a, ac = c - a, normal = glm::cross(ab, ac);
  const double off = kRoundings * sum(ab) * sum(ac);
  const double height = std::abs(glm::dot(normal, a)) - off * (sum(a) + radius);
  return height > 0.0 &&
         height * height > radius * radius * (1.0 + kRelative) * glm::dot(normal, normal);
}

class NearestVisitor final : public BallVisitor {
 public:
  NearestVisitor(const MeshTriangles& triangles, const glm::dvec3& point, double max_radius)
      : triangles_(triangles), point_(point), radius_(max_radius) {}

  double visit(std::uint32_t k) override {
    // Relative to the point, where a short distance has all its digits.
    const auto c = triangles_.corners(k);
    const glm::dvec3 p = c[0] - point_, q = c[1] - point_, r = c[2] - point_;
    if (plane_is_beyond(p, q, r, radius_)) return radius_;
    const glm::dvec3 apart = nearest_on_triangle(glm::dvec3(0.0), p, q, r);
    const double distance = std::sqrt(glm::dot(apart, apart));
    if (distance > radius_) return radius_;
    if (distance < best_.distance_m || (distance == best_.distance_m && k < best_.triangle)) {
      best_ = {point_ + apart, distance, k};
      radius_ = distance;
    }
    return radius_;
  }
  const NearestPoint& best() const { return best_; }

 private:
  const MeshTriangles& triangles_;
  const glm::dvec3& point_;
  double radius_;
  NearestPoint best_;
};

void require_point(const glm::dvec3& p) {
  require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
          "a point must be finite, got ({}, {}, {})", p.x, p.y, p.z);
}

void require_radius(double radius) {
  require(radius >= 0.0, "max_radius_m must be >= 0, got {}", radius);
}

}  // namespace

struct MeshNearest::Scene {
  MeshTriangles triangles;
  BoxTree tree;

  explicit Scene(const TriangleMesh& mesh)
      : triangles(mesh),
        tree(triangles.count(), [this](std::uint32_t k) { return triangles.box(k); }) {}

  NearestPoint nearest(const glm::dvec3& point, double max_radius, std::uint32_t first) const {
    NearestVisitor visitor(triangles, point, max_radius);
    if (first < triangles.count()) max_radius = visitor.visit(first);
    tree.visit_ball(point, max_radius, visitor);
    return visitor.best();
  }
};

MeshNearest::MeshNearest(const TriangleMesh& mesh) : scene_(std::make_unique<Scene>(mesh)) {}
MeshNearest::~MeshNearest() = default;
MeshNearest::MeshNearest(MeshNearest&&) noexcept = default;
MeshNearest& MeshNearest::operator=(MeshNearest&&) noexcept = default;

NearestPoint MeshNearest::nearest(const glm::dvec3& point_m, double max_radius_m,
                                  std::uint32_t near_triangle) const {
  require_point(point_m);
  require_radius(max_radius_m);
  return scene_->nearest(point_m, max_radius_m, near_triangle);
}

std::vector<NearestPoint> MeshNearest::nearest(std::span<const glm::dvec3> points_m,
                                               double max_radius_m) const {
  for (const glm::dvec3& point : points_m) require_point(point);
  require_radius(max_radius_m);
  std::vector<NearestPoint> found(points_m.size());
  parallel_for(static_cast<std::int64_t>(points_m.size()), 64, [&](std::int64_t k) {
    const auto slot = static_cast<std::size_t>(k);
    found[slot] = scene_->nearest(points_m[slot], max_radius_m, kNoPrimitive);
  });
  return found;
}

}  // namespace plumb::reference
