#include "audit/topology.h"

#include <algorithm>
#include <cmath>

#include "audit/flat_triangle.h"
#include "audit/mesh_examination.h"

namespace plumb::audit {
namespace {

constexpr double kBeside =
    1e-6;  // cells: how far from an edge to look for the surface on either side of it

// A sheet over the terrain, seen from above.
class TerrainRules final : public SheetRules {
 public:
  explicit TerrainRules(const HeightfieldTruth& truth) : truth_(truth) {}

  glm::dvec3 origin_m() const override { return truth_.field().world_origin_m(); }
  double beside_m() const override {
    return kBeside * std::min(truth_.field().dx_m, truth_.field().dy_m);
  }
  glm::dvec3 place(const glm::dvec3& point_m) const override { return {point_m.x, point_m.y, 0.0}; }
  bool is_folded(const glm::dvec3& normal, const glm::dvec3& a, const glm::dvec3& b,
                 const glm::dvec3& c) const override {
    return normal.z < 0.0 && FlatTriangle(a, b, c).is_flat();
  }
  bool folds_at_edges() const override { return false; }
  bool is_folded_at_edge(const glm::dvec3&, const glm::dvec3&) const override { return false; }

  // The surface goes on on both sides of the edge, at its middle or at a quarter of it.
  bool is_open(const glm::dvec3& a, const glm::dvec3& b) const override {
    const glm::dvec3 d = b - a;
    const double length = std::sqrt(d.x * d.x + d.y * d.y);
    if (!(length > 0.0)) return false;
    const double step = beside_m();
    const glm::dvec2 beside{-d.y / length * step, d.x / length * step};
    for (const double share : {0.5, 0.25, 0.75}) {
      const double x = a.x + share * d.x, y = a.y + share * d.y;
      if (inside_terrain(x + beside.x, y + beside.y) && inside_terrain(x - beside.x, y - beside.y))
        return true;
    }
    return false;
  }

  // Where voids touch at a sample, the terrain itself hangs together by that point alone.
  bool may_pinch(const glm::dvec3& at) const override {
    const terrain::Heightfield& field = truth_.field();
    int changes = 0;
    bool before = false;
    constexpr int kDirections = 16;
    for (int k = 0; k <= kDirections; ++k) {
      static constexpr int kAcross[kDirections] = {4,  4,  3,  2,  0, -2, -3, -4,
                                                   -4, -4, -3, -2, 0, 2,  3,  4};
      static constexpr int kUp[kDirections] = {0, 2,  3,  4,  4,  4,  3,  2,
                                               0, -2, -3, -4, -4, -4, -3, -2};
      const int d = k % kDirections;
      // Off the axes and the diagonals, where neighbouring triangles meet.
      const double x = at.x + kBeside * field.dx_m * (kAcross[d] + 0.25),
                   y = at.y + kBeside * field.dy_m * (kUp[d] + 0.125);
      const bool here = inside_terrain(x, y);
      changes += k > 0 && here != before;
      before = here;
    }
    return changes > 2;
  }

 private:
  bool inside_terrain(double x, double y) const {
    return reference::exists_at(truth_.field(), truth_.diagonal(), x, y);
  }

  const HeightfieldTruth& truth_;
};

}  // namespace

Topology topology_of(const HeightfieldTruth& truth, const DrawnSurface& surface,
                     const MeshEdges& edges, int most_listed) {
  return examined(TerrainRules(truth), surface, edges, most_listed);
}

}  // namespace plumb::audit
