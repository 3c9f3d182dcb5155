// Greedy insertion into a Delaunay triangulation: the sample that is farthest off is added until
// none is farther than asked. Keeps its bound by construction: a subject that the audit must
// acquit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <queue>
#include <utility>
#include <vector>

#include "core/drawn_surface.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

/// Coordinates are samples' columns and rows, so that all predicates are exact in 64 bits (the
/// largest, four coordinates multiplied, needs fields of less than 2^15 samples a side). A point
/// goes in by taking out the triangles whose circles hold it and closing the hole with a fan.
/// Source: [Garland & Heckbert 1995, algorithm III], with the cavity of [Bowyer 1981; Watson 1981].
class GreedyInsertion {
 public:
  /// A terrain of at least 2 x 2 samples without voids.
  explicit GreedyInsertion(const terrain::Heightfield& field) : field_(field) {
    const int i = field.columns() - 1, j = field.rows() - 1;
    const int sw = add_point({0, 0}), se = add_point({i, 0}), ne = add_point({i, j}),
              nw = add_point({0, j});
    add_triangle({sw, se, ne});
    add_triangle({sw, ne, nw});
  }

  /// Inserts until every sample lies within `bound_m`, and claims that.
  DrawnSurface mesh(double bound_m) {
    while (!worst_.empty() && worst_.top().error > bound_m) {
      const Worst worst = worst_.top();
      worst_.pop();
      if (alive(worst.triangle)) insert(worst.at, worst.triangle);
    }
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->origin_m = field_.world_origin_m();
    for (const Point& p : points_)
      mesh->vertices_m.emplace_back(p.i * field_.dx_m, p.j * field_.dy_m, height(p));
    for (const Corners& t : triangles_) {
      if (t[0] < 0) continue;
      mesh->triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                                 static_cast<std::uint32_t>(t[2])});
    }
    DrawnSurface surface;
    surface.mesh = std::move(mesh);
    surface.claims = {{Measure::SampleError, bound_m, Unit::Metre}};
    return surface;
  }

 private:
  struct Point {
    int i, j;
  };
  using Corners = std::array<int, 3>;  // counter-clockwise; the first is -1 once taken out
  struct Worst {
    double error;
    int triangle;
    Point at;
    friend bool operator<(const Worst& a, const Worst& b) {
      return a.error != b.error ? a.error < b.error : a.triangle > b.triangle;
    }
  };

  double height(const Point& p) const { return field_.heights_m(p.i, p.j); }
  const Point& corner(int triangle, int k) const {
    return points_[static_cast<std::size_t>(
        triangles_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(k)])];
  }
  bool alive(int triangle) const { return triangles_[static_cast<std::size_t>(triangle)][0] >= 0; }

  // Twice the area; positive if c lies to the left of a -> b.
  static std::int64_t area(const Point& a, const Point& b, const Point& c) {
    return std::int64_t{b.i - a.i} * (c.j - a.j) - std::int64_t{b.j - a.j} * (c.i - a.i);
  }
  // Inside the circle around a counter-clockwise triangle, not on it.
  bool in_circle(int triangle, const Point& p) const {
    std::array<std::int64_t, 3> x, y, r;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      x[at] = corner(triangle, k).i - p.i;
      y[at] = corner(triangle, k).j - p.j;
      r[at] = x[at] * x[at] + y[at] * y[at];
    }
    return r[0] * (x[1] * y[2] - x[2] * y[1]) - r[1] * (x[0] * y[2] - x[2] * y[0]) +
               r[2] * (x[0] * y[1] - x[1] * y[0]) >
           0;
  }

  int add_point(const Point& p) {
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  void add_triangle(const Corners& corners) {
    const int triangle = static_cast<int>(triangles_.size());
    triangles_.push_back(corners);
    for (std::size_t k = 0; k < 3; ++k) beside_[{corners[k], corners[(k + 1) % 3]}] = triangle;
    find_worst(triangle);
  }

  // The sample under a triangle, borders included, that is farthest off.
  void find_worst(int triangle) {
    const Point &a = corner(triangle, 0), &b = corner(triangle, 1), &c = corner(triangle, 2);
    const auto whole = static_cast<double>(area(a, b, c));
    Worst worst{0.0, triangle, a};
    for (int j = std::min({a.j, b.j, c.j}); j <= std::max({a.j, b.j, c.j}); ++j) {
      for (int i = std::min({a.i, b.i, c.i}); i <= std::max({a.i, b.i, c.i}); ++i) {
        const Point p{i, j};
        const std::int64_t at_a = area(b, c, p), at_b = area(c, a, p), at_c = area(a, b, p);
        if (at_a < 0 || at_b < 0 || at_c < 0) continue;
        const double z =
            (static_cast<double>(at_a) * height(a) + static_cast<double>(at_b) * height(b) +
             static_cast<double>(at_c) * height(c)) /
            whole;
        const double error = std::abs(z - height(p));
        if (error > worst.error) worst = {error, triangle, p};
      }
    }
    if (worst.error > 0.0) worst_.push(worst);
  }

  void insert(const Point& p, int first) {
    // The cavity: triangles whose circles hold the point, from the one that it lies in.
    std::vector<int> cavity{first};
    std::vector<std::pair<int, int>> rim;
    std::map<int, bool> taken{{first, true}};
    for (std::size_t next = 0; next < cavity.size(); ++next) {
      const Corners t = triangles_[static_cast<std::size_t>(cavity[next])];
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = t[k], to = t[(k + 1) % 3];
        const auto other = beside_.find({to, from});
        if (other != beside_.end() && taken.count(other->second) == 0 &&
            in_circle(other->second, p)) {
          taken[other->second] = true;
          cavity.push_back(other->second);
        }
      }
    }
    for (const int triangle : cavity) {
      const Corners t = triangles_[static_cast<std::size_t>(triangle)];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto other = beside_.find({t[(k + 1) % 3], t[k]});
        if (other == beside_.end() || taken.count(other->second) == 0)
          rim.emplace_back(t[k], t[(k + 1) % 3]);
      }
    }
    for (const int triangle : cavity) {
      Corners& t = triangles_[static_cast<std::size_t>(triangle)];
      for (std::size_t k = 0; k < 3; ++k) beside_.erase({t[k], t[(k + 1) % 3]});
      t[0] = -1;
    }
    const int middle = add_point(p);
    for (const auto& [from, to] : rim) {
      const auto at = [this](int k) { return points_[static_cast<std::size_t>(k)]; };
      if (area(at(from), at(to), p) > 0) add_triangle({from, to, middle});  // else p is on a border
    }
  }

  const terrain::Heightfield& field_;
  std::vector<Point> points_;
  std::vector<Corners> triangles_;
  std::map<std::pair<int, int>, int> beside_;  // the triangle to the left of an edge
  std::priority_queue<Worst> worst_;
};

}  // namespace plumb::test_support
