#include "audit/stability/printed_quadtree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "core/check.h"
#include "core/grid.h"
#include "mesh/restricted_quadtree/bintree.h"

namespace plumb::audit::stability {
namespace {

using namespace mesh::restricted_quadtree;

class Patch {
 public:
  Patch(const terrain::Heightfield& field, double threshold_m, const PrintedRules& rules)
      : field_(field),
        threshold_m_(threshold_m),
        rules_(rules),
        side_((field.columns() - 1) / rules.step),
        enabled_(side_ + 1, side_ + 1, 0) {
    for (int half = 1; 2 * half <= side_; half *= 2) {
      decide(half, false);  // the middles of cells' sides
      decide(half, true);   // the cells' centres
    }
  }

  TriangleMesh mesh() const {
    TriangleMesh mesh;
    for (int j = 0; j <= side_; ++j)
      for (int i = 0; i <= side_; ++i)
        mesh.vertices_m.push_back(
            {i * rules_.step * field_.dx_m, j * rules_.step * field_.dy_m, height({i, j})});
    for (const BinTriangle& root : root_triangles(side_)) add(root, mesh);
    return mesh;
  }

 private:
  bool is_inside(Corner v) const { return std::min(v.i, v.j) >= 0 && std::max(v.i, v.j) <= side_; }
  bool is_on(Corner v) const { return is_inside(v) && enabled_(v.i, v.j) != 0; }
  double height(Corner v) const { return field_.heights_m(v.i * rules_.step, v.j * rules_.step); }

  void decide(int half, bool centres) {
    for (int j = 0; j <= side_; ++j) {
      for (int i = 0; i <= side_; ++i) {
        if ((i % (2 * half) != half) && (j % (2 * half) != half)) continue;
        const BaseShape shape = base_shape({i, j});
        if (shape.half == half && shape.is_centre == centres)
          enabled_(i, j) = is_kept({i, j}) ? 1 : 0;
      }
    }
  }
  bool is_kept(Corner v) const {
    for (int which = 0; which < 2; ++which) {
      const BinTriangle triangle = triangle_of_base(v, which);
      if (!is_inside(triangle.c)) continue;
      if (error_m(triangle) >= threshold_m_) return true;
      if (rules_.word_for_word) {
        if (is_on(triangle.c)) return true;
        continue;
      }
      for (const BinTriangle& child : children(triangle))
        if (!is_finest(child) && is_on(base_vertex(child))) return true;
    }
    return false;
  }

  // Over the patch's own samples, edges included.
  double error_m(const BinTriangle& t) const {
    const auto twice = [](Corner a, Corner b, Corner c) {
      return (b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i);
    };
    const int area = twice(t.a, t.b, t.c);
    double worst_m = 0.0;
    for (int j = std::min({t.a.j, t.b.j, t.c.j}); j <= std::max({t.a.j, t.b.j, t.c.j}); ++j) {
      for (int i = std::min({t.a.i, t.b.i, t.c.i}); i <= std::max({t.a.i, t.b.i, t.c.i}); ++i) {
        const Corner p{i, j};
        const int u = twice(p, t.b, t.c), v = twice(t.a, p, t.c), w = twice(t.a, t.b, p);
        if (std::min({u, v, w}) < 0) continue;
        const double plane = (u * height(t.a) + v * height(t.b) + w * height(t.c)) / area;
        worst_m = std::max(worst_m, std::abs(plane - height(p)));
      }
    }
    return worst_m;
  }

  void add(const BinTriangle& triangle, TriangleMesh& mesh) const {
    if (!is_finest(triangle) && is_on(base_vertex(triangle))) {
      for (const BinTriangle& child : children(triangle)) add(child, mesh);
      return;
    }
    const auto index = [&](Corner v) {
      return static_cast<std::uint32_t>(v.j * (side_ + 1) + v.i);
    };
    mesh.triangles.push_back({index(triangle.a), index(triangle.b), index(triangle.c)});
  }

  const terrain::Heightfield& field_;
  double threshold_m_;
  PrintedRules rules_;
  int side_;
  Grid<std::uint8_t> enabled_;
};

}  // namespace

DrawnSurface printed_quadtree(const terrain::Heightfield& field, const Tolerance& threshold,
                              const PrintedRules& rules) {
  const int cells = field.columns() - 1;
  if (cells < rules.step || field.rows() != field.columns() ||
      !std::has_single_bit(static_cast<unsigned>(cells)))
    input_error("a patch as printed has 2^n + 1 samples a side, not {} x {}", field.columns(),
                field.rows());
  if (threshold.unit != Unit::Metre) input_error("a patch's threshold as printed is in metres");
  for (int j = 0; j < field.rows(); ++j)
    for (int i = 0; i < field.columns(); ++i)
      if (field.is_void(i, j)) input_error("a patch as printed has no voids");
  DrawnSurface surface;
  auto mesh = std::make_shared<TriangleMesh>(Patch(field, threshold.value, rules).mesh());
  surface.cost.vertices = static_cast<std::int64_t>(mesh->vertices_m.size());
  surface.cost.triangles = static_cast<std::int64_t>(mesh->triangles.size());
  surface.mesh = std::move(mesh);
  surface.claims = {{Measure::SampleError, threshold.value, Unit::Metre}};
  return surface;
}

}  // namespace plumb::audit::stability
