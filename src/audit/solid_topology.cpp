#include "audit/solid_topology.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "audit/mesh_examination.h"
#include "audit/self_intersections.h"

namespace plumb::audit {
namespace {

class SolidRules final : public SheetRules {
 public:
  explicit SolidRules(const terrain::Heightfield& field)
      : field_(field),
        east_m_(field.cell_columns() * field.dx_m),
        north_m_(field.cell_rows() * field.dy_m) {}

  glm::dvec3 origin_m() const override { return field_.world_origin_m(); }
  double beside_m() const override { return 1e-6 * std::min(field_.dx_m, field_.dy_m); }
  glm::dvec3 place(const glm::dvec3& point_m) const override { return point_m; }
  bool is_open(const glm::dvec3& a, const glm::dvec3& b) const override {
    const auto both_at = [&](double p, double q, double side) {
      return std::abs(p - side) <= beside_m() && std::abs(q - side) <= beside_m();
    };
    return !(both_at(a.x, b.x, 0.0) || both_at(a.x, b.x, east_m_) || both_at(a.y, b.y, 0.0) ||
             both_at(a.y, b.y, north_m_));
  }
  bool is_folded(const glm::dvec3&, const glm::dvec3&, const glm::dvec3&,
                 const glm::dvec3&) const override {
    return false;
  }
  bool folds_at_edges() const override { return true; }
  bool is_folded_at_edge(const glm::dvec3& a, const glm::dvec3& b) const override {
    constexpr double kCosine = -0.8660254037844386;  // of 150 degrees
    return glm::dot(a, b) < kCosine * std::sqrt(glm::dot(a, a) * glm::dot(b, b));
  }
  bool may_pinch(const glm::dvec3&) const override { return false; }

 private:
  const terrain::Heightfield& field_;
  double east_m_, north_m_;
};

}  // namespace

Topology solid_topology_of(const MeshTruth& truth, const DrawnSurface& surface,
                           const MeshEdges& edges, int most_listed) {
  Topology topology = examined(SolidRules(truth.field()), surface, edges, most_listed);
  topology.self_intersections = self_intersections_of(*surface.mesh);
  return topology;
}

}  // namespace plumb::audit
