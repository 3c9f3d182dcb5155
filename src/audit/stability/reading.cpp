#include "audit/stability/reading.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/surface_picture.h"
#include "core/grid.h"

namespace plumb::audit::stability {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

// The highest point of the mesh over each sample; nothing where there is none.
Grid<double> tops_of(const TriangleMesh& mesh, const terrain::Heightfield& field) {
  Grid<double> top(field.columns(), field.rows(), kNothing);
  for (const Triangle& t : mesh.triangles) {
    glm::dvec2 at[3];
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = {mesh.vertices_m[t[k]].x / field.dx_m, mesh.vertices_m[t[k]].y / field.dy_m};
    const glm::dvec2 low = glm::min(at[0], glm::min(at[1], at[2])),
                     high = glm::max(at[0], glm::max(at[1], at[2]));
    const auto twice = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
      return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const double area = twice(at[0], at[1], at[2]);
    if (area == 0.0) continue;
    const int i1 = std::min(static_cast<int>(std::floor(high.x)), field.columns() - 1),
              j1 = std::min(static_cast<int>(std::floor(high.y)), field.rows() - 1);
    for (int j = std::max(static_cast<int>(std::ceil(low.y)), 0); j <= j1; ++j) {
      for (int i = std::max(static_cast<int>(std::ceil(low.x)), 0); i <= i1; ++i) {
        const glm::dvec2 p(i, j);
        const double u = twice(p, at[1], at[2]) / area, v = twice(at[0], p, at[2]) / area,
                     w = twice(at[0], at[1], p) / area;
        if (std::min({u, v, w}) < -1e-12) continue;
        top(i, j) = std::max(top(i, j), u * mesh.vertices_m[t[0]].z + v * mesh.vertices_m[t[1]].z +
                                            w * mesh.vertices_m[t[2]].z);
      }
    }
  }
  return top;
}

// Where nothing is drawn, from the lowest point of the terrain.
double top_error_m(const terrain::Heightfield& field, const DrawnSurface& surface) {
  if (surface.mesh == nullptr) return 0.0;
  const Grid<double> drawn = tops_of(*surface.mesh, field);
  const double lowest_m = terrain::bounds(field).low.z;
  double worst_m = 0.0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      if (field.is_void(i, j)) continue;
      const double top_m = drawn(i, j) == kNothing ? lowest_m : drawn(i, j);
      worst_m = std::max(worst_m, std::abs(double{field.heights_m(i, j)} - top_m));
    }
  }
  return worst_m;
}

double colour_error(const MeshTruth& truth, const DrawnSurface& surface, const AuditResult& result,
                    const Camera& camera) {
  const std::vector<glm::vec3> meant = vertex_albedo(truth.surface(), result.true_hits, camera),
                               drawn = vertex_albedo(surface, result.drawn, camera);
  double worst = 0.0;
  for (std::size_t k = 0; k < std::min(meant.size(), drawn.size()); ++k) {
    if (!result.true_hits.hit(k) || !result.drawn.hit(k)) continue;
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(double{meant[k][c]} - double{drawn[k][c]}));
  }
  return worst;
}

}  // namespace

double value_of(Reading reading, Unit asked, const TruthTerms& truth, const DrawnSurface& surface,
                const AuditResult& result, const Camera& camera) {
  const bool in_metres = asked == Unit::Metre;
  const Topology& topology = result.topology;
  switch (reading) {
    case Reading::PixelError:
      return result.pixels.max_vertical_px;
    case Reading::SampleError:
      return in_metres ? result.samples.worst_m.error : result.samples.worst_px.error;
    case Reading::SurfaceError:
      return in_metres ? std::max(result.samples.worst_m.error, result.edges.max_m)
                       : std::max(result.samples.worst_px.error, result.edges.max_px);
    case Reading::NearestError:
      return std::max(result.nearest.forward.max, result.nearest.reverse.max);
    case Reading::Coverage:
      return static_cast<double>(result.coverage.defect_count());
    case Reading::OpenEdges:
      return static_cast<double>(topology.open_edges);
    case Reading::TJunctions:
      return static_cast<double>(topology.t_junctions);
    case Reading::NonManifold:
      return static_cast<double>(topology.non_manifold_edges + topology.non_manifold_vertices);
    case Reading::Folded:
      return static_cast<double>(topology.folded_triangles);
    case Reading::LevelJump:
      return topology.largest_lod_jump;
    case Reading::Triangles:
      return static_cast<double>(surface.cost.triangles);
    case Reading::TopError:
      return top_error_m(truth.field(), surface);
    case Reading::ColourError:
      return colour_error(*truth.mesh(), surface, result, camera);
  }
  return 0.0;
}

}  // namespace plumb::audit::stability
