#include "reference/mesh_nearest.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/check.h"
#include "core/parallel.h"
#include "reference/box_tree.h"
#include "reference/mesh_triangles.h"
#include "reference/triangle_distance.h"

namespace plumb::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
  NearestVisitor() = default;
  NearestVisitor(const MeshTriangles& triangles, const NearestQuery& query)
      : triangles_(&triangles), point_(query.point_m), radius_(query.max_radius_m) {
    if (query.near_triangle < triangles.count()) visit(query.near_triangle);
  }

  double visit(std::uint32_t k) override {
    // Relative to the point, where a short distance has all its digits.
    const auto c = triangles_->corners(k);
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
  const glm::dvec3& point() const { return point_; }
  double radius() const { return radius_; }
  const NearestPoint& best() const { return best_; }

 private:
  const MeshTriangles* triangles_ = nullptr;
  glm::dvec3 point_{0.0};
  double radius_ = 0.0;
  NearestPoint best_;
};

// Keeps what a ball may meet, as long as it is little.
class Collector final : public BallVisitor {
 public:
  explicit Collector(double radius) : radius_(radius) {}
  double visit(std::uint32_t k) override {
    if (count_ == kMost) return full_ = true, 0.0;
    found_[count_++] = k;
    return radius_;
  }
  bool full() const { return full_; }
  std::span<const std::uint32_t> found() const { return std::span(found_).first(count_); }

 private:
  static constexpr std::size_t kMost = 128;
  double radius_;
  std::array<std::uint32_t, kMost> found_;
  std::size_t count_ = 0;
  bool full_ = false;
};

// Some balls side by side, to be asked which of them may reach into a box.
class Balls {
 public:
  explicit Balls(std::span<const NearestVisitor> visitors) : count_(visitors.size()) {
    for (std::size_t k = 0; k < count_; ++k) {
      const glm::dvec3& point = visitors[k].point();
      x_[k] = point.x;
      y_[k] = point.y;
      z_[k] = point.z;
      set_radius(k, visitors[k].radius());
    }
  }
  void set_radius(std::size_t k, double radius) {
    constexpr double kRoundings = 1e-9;
    limit_[k] = radius * radius * (1.0 + kRoundings);
  }
  // Plain enough for vectors.
  void reaching(const Box& box, std::array<double, MeshNearest::kTogether>& over) const {
    const glm::dvec3 low = box.low, high = box.high;
    for (std::size_t k = 0; k < count_; ++k) {
      const double x = outside(x_[k], low.x, high.x), y = outside(y_[k], low.y, high.y),
                   z = outside(z_[k], low.z, high.z);
      over[k] = x * x + y * y + z * z - limit_[k];
    }
  }

 private:
  static double outside(double at, double low, double high) {
    const double below = low - at, above = at - high, either = below > above ? below : above;
    return either > 0.0 ? either : 0.0;
  }
  std::size_t count_;
  std::array<double, MeshNearest::kTogether> x_, y_, z_, limit_;
};

// Around some balls.
struct Ball {
  glm::dvec3 centre;
  double radius = 0.0;

  explicit Ball(std::span<const NearestVisitor> balls) {
    Box box;
    for (const NearestVisitor& ball : balls) box.add(ball.point());
    centre = 0.5 * (box.low + box.high);
    for (const NearestVisitor& ball : balls) {
      const glm::dvec3 apart = ball.point() - centre;
      radius = std::max(radius, std::sqrt(glm::dot(apart, apart)) + ball.radius());
    }
    radius *= 1.0 + 1e-9;  // the roundings of these sums
  }
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
        tree(
            triangles.count(), [this](std::uint32_t k) { return triangles.box(k); }, {},
            TreeBuild::Quick) {}

  NearestPoint nearest(const NearestQuery& query) const {
    NearestVisitor visitor(triangles, query);
    tree.visit_ball(query.point_m, visitor.radius(), visitor);
    return visitor.best();
  }

  void visit_together(std::span<NearestVisitor> visitors) const {
    const Ball ball(visitors);
    Collector collector(ball.radius);
    if (ball.radius < kInfinity) tree.visit_ball(ball.centre, ball.radius, collector);
    if (ball.radius == kInfinity || collector.full()) {
      for (NearestVisitor& visitor : visitors)
        tree.visit_ball(visitor.point(), visitor.radius(), visitor);
      return;
    }
    Balls balls(visitors);
    std::array<double, kTogether> over;
    for (const std::uint32_t k : collector.found()) {
      balls.reaching(triangles.box(k), over);
      for (std::size_t at = 0; at < visitors.size(); ++at) {
        if (over[at] <= 0.0) balls.set_radius(at, visitors[at].visit(k));
      }
    }
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
  return scene_->nearest({point_m, max_radius_m, near_triangle});
}

void MeshNearest::nearest_together(std::span<const NearestQuery> queries,
                                   std::span<NearestPoint> found) const {
  require(queries.size() <= kTogether && queries.size() == found.size(),
          "at most {} queries and as many answers, got {} and {}", kTogether, queries.size(),
          found.size());
  if (queries.empty()) return;
  std::array<NearestVisitor, kTogether> visitors;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    require_point(queries[k].point_m);
    require_radius(queries[k].max_radius_m);
    visitors[k] = NearestVisitor(scene_->triangles, queries[k]);
  }
  scene_->visit_together(std::span(visitors).first(queries.size()));
  for (std::size_t k = 0; k < queries.size(); ++k) found[k] = visitors[k].best();
}

std::vector<NearestPoint> MeshNearest::nearest(std::span<const glm::dvec3> points_m,
                                               double max_radius_m) const {
  for (const glm::dvec3& point : points_m) require_point(point);
  require_radius(max_radius_m);
  std::vector<NearestPoint> found(points_m.size());
  parallel_for(static_cast<std::int64_t>(points_m.size()), 64, [&](std::int64_t k) {
    const auto slot = static_cast<std::size_t>(k);
    found[slot] = scene_->nearest({points_m[slot], max_radius_m});
  });
  return found;
}

}  // namespace plumb::reference
