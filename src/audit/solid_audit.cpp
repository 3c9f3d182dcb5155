#include "audit/solid_audit.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "audit/audit_input.h"
#include "audit/claim_check.h"
#include "audit/frame_audit.h"
#include "audit/solid_coverage.h"
#include "audit/solid_nearest.h"
#include "audit/solid_topology.h"
#include "core/check.h"
#include "core/stopwatch.h"

namespace plumb::audit {
namespace {

// The first triangle that uses a vertex: by it a report names the patch.
std::uint32_t triangle_of(const TriangleMesh& mesh, std::uint32_t vertex) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) return t;
  }
  return kNoPrimitive;
}

void measure_nearest(AuditResult& result, const MeshTruth& truth, const TriangleMesh& drawn,
                     const NearestSide& to_drawn, const Camera& camera) {
  const NearestSide to_truth{truth.mesh(), truth.nearest(), truth.slack_m() + to_drawn.slack_m};
  const glm::dvec3 origin = truth.field().world_origin_m();
  NearestErrors& n = result.nearest;
  NearestMaps forward = nearest_maps(result.drawn, camera, to_truth, result.true_hits.primitive);
  n.forward_px = std::move(forward.px);
  n.forward_m = std::move(forward.metres);
  n.forward = distribution_of(n.forward_px);
  n.forward_metres = distribution_of(n.forward_m);
  NearestMaps reverse = nearest_maps(result.true_hits, camera, to_drawn, result.drawn.primitive);
  n.reverse_px = std::move(reverse.px);
  n.reverse_m = std::move(reverse.metres);
  n.reverse_triangle = std::move(reverse.triangle);
  n.reverse = distribution_of(n.reverse_px);
  n.reverse_metres = distribution_of(n.reverse_m);
  n.forward_vertices = vertex_distances(drawn, to_truth, origin);
  n.forward_vertices.worst_triangle = triangle_of(drawn, n.forward_vertices.worst_vertex);
  n.reverse_vertices = vertex_distances(truth.mesh(), to_drawn, origin);
}

}  // namespace

AuditResult audit_picture(const MeshTruth& truth, HitImage true_hits, const DrawnSurface& surface,
                          HitImage drawn, const Camera& camera, const AuditOptions& options) {
  require(surface.mesh != nullptr, "held against a mesh, a drawn surface must be a mesh too");
  require_consistent(true_hits, surface, drawn, camera);
  Stopwatch watch;
  AuditResult result;
  result.of_heights = false;
  result.cost = surface.cost;
  result.true_hits = std::move(true_hits);
  result.drawn = std::move(drawn);
  const TriangleMesh& mesh = *surface.mesh;
  std::optional<reference::MeshNearest> nearest;
  if (!mesh.triangles.empty()) nearest.emplace(mesh);
  const NearestSide to_drawn{mesh, nearest, truth.slack_m() + mesh_slack_m(mesh)};
  result.depth = distribution_of(depth_errors(result.true_hits, result.drawn));
  result.normal_deg =
      distribution_of(normal_errors_deg(truth.mesh(), result.true_hits, mesh, result.drawn));
  if (options.nearest) measure_nearest(result, truth, mesh, to_drawn, camera);
  result.coverage = solid_coverage_of(truth, result.true_hits, result.drawn, camera, surface,
                                      to_drawn, options.band);
  result.topology = solid_topology_of(truth, surface, MeshEdges(mesh), options.most_listed);
  result.registration = registration_of(&mesh, result.drawn, camera);
  check_claims(result, truth, surface, camera, options);
  result.times.measure_s = watch.lap_s();
  return result;
}

AuditResult audit_surface(const MeshTruth& truth, const DrawnSurface& surface, const Camera& camera,
                          const AuditOptions& options) {
  return audit_frame(truth, surface, camera, options);
}

}  // namespace plumb::audit
