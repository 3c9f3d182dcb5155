// Right-triangulated irregular networks by accumulated midpoint errors: a scheme that libraries use
// and that does not keep the error it states. A subject for the audit, written from the published
// description of the scheme.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/drawn_surface.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

/// A vertex's error is the larger of its own distance from the middle of its hypotenuse and of the
/// errors that were stored at its children's vertices; nothing looks at the samples in between.
/// Heights and errors are float32, middles double.
class ApproximateRtin {
 public:
  /// A square terrain of 2^n + 1 samples without voids.
  explicit ApproximateRtin(const terrain::Heightfield& field)
      : field_(field), size_(field.columns()) {
    errors_.assign(static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_), 0.0f);
    // From the smallest triangles to the largest: by level, each level over the whole square.
    const int levels = 2 * static_cast<int>(std::lround(std::log2(size_ - 1)));
    for (int level = levels - 1; level >= 0; --level) {
      accumulate({0, size_ - 1}, {size_ - 1, 0}, {size_ - 1, size_ - 1}, level,
                 level == levels - 1);
      accumulate({size_ - 1, 0}, {0, size_ - 1}, {0, 0}, level, level == levels - 1);
    }
  }

  /// The mesh for a stated error, which it claims for every sample.
  DrawnSurface mesh(double stated_m) const {
    DrawnSurface surface;
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->origin_m = field_.world_origin_m();
    std::vector<std::uint32_t> vertex(errors_.size(), kNoPrimitive);
    emit({0, size_ - 1}, {size_ - 1, 0}, {size_ - 1, size_ - 1}, stated_m, *mesh, vertex);
    emit({size_ - 1, 0}, {0, size_ - 1}, {0, 0}, stated_m, *mesh, vertex);
    surface.mesh = std::move(mesh);
    surface.claims = {{Measure::SampleError, stated_m, Unit::Metre}};
    return surface;
  }

 private:
  struct Point {
    int i, j;
  };
  static Point middle(Point a, Point b) { return {(a.i + b.i) / 2, (a.j + b.j) / 2}; }
  std::size_t at(Point p) const {
    return static_cast<std::size_t>(p.j) * static_cast<std::size_t>(size_) +
           static_cast<std::size_t>(p.i);
  }
  double height(Point p) const { return field_.heights_m(p.i, p.j); }

  void accumulate(Point a, Point b, Point c, int level, bool smallest) {
    const Point m = middle(a, b);
    if (level > 0) {
      accumulate(c, a, m, level - 1, smallest);
      accumulate(b, c, m, level - 1, smallest);
      return;
    }
    float& error = errors_[at(m)];
    error =
        std::max(error, static_cast<float>(std::abs((height(a) + height(b)) / 2.0 - height(m))));
    if (!smallest) error = std::max({error, errors_[at(middle(c, a))], errors_[at(middle(b, c))]});
  }

  void emit(Point a, Point b, Point c, double stated_m, TriangleMesh& mesh,
            std::vector<std::uint32_t>& vertex) const {
    const Point m = middle(a, b);
    if (std::abs(a.i - c.i) + std::abs(a.j - c.j) > 1 &&
        static_cast<double>(errors_[at(m)]) > stated_m) {
      emit(c, a, m, stated_m, mesh, vertex);
      emit(b, c, m, stated_m, mesh, vertex);
      return;
    }
    const auto number = [&](Point p) {
      std::uint32_t& v = vertex[at(p)];
      if (v == kNoPrimitive) {
        v = static_cast<std::uint32_t>(mesh.vertices_m.size());
        mesh.vertices_m.emplace_back(p.i * field_.dx_m, p.j * field_.dy_m, height(p));
      }
      return v;
    };
    Triangle triangle{number(a), number(b), number(c)};
    const glm::dvec3 normal = area_normal(
        mesh.vertices_m[triangle[0]], mesh.vertices_m[triangle[1]], mesh.vertices_m[triangle[2]]);
    if (normal.z < 0.0) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }

  const terrain::Heightfield& field_;
  int size_;
  std::vector<float> errors_;
};

}  // namespace plumb::test_support
