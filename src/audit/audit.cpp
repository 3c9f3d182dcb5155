#include "audit/audit.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "audit/audit_input.h"
#include "audit/claim_check.h"
#include "audit/frame_audit.h"
#include "audit/nearest_error.h"
#include "audit/set_aside.h"
#include "core/stopwatch.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What only a mesh has: a height over each sample, edges, normals, and points for the truth to be
// held against.
void measure_mesh(AuditResult& result, const HeightfieldTruth& truth, const DrawnSurface& surface,
                  const Camera& camera, const AuditOptions& options) {
  const TriangleMesh& mesh = *surface.mesh;
  result.samples = sample_errors(truth, result.true_hits, surface, camera, options.most_listed);
  const MeshEdges edges(mesh);
  result.edges = edge_errors(truth, mesh, edges, camera);
  result.reverse_pixels = reverse_vertical_errors(truth, result.true_hits, mesh, camera);
  result.reverse_vertical = distribution_of(result.reverse_pixels.vertical_px);
  result.normal_deg =
      distribution_of(normal_errors_deg(truth, result.true_hits, mesh, result.drawn));
  if (options.nearest) {
    result.nearest.reverse_px =
        reverse_nearest_errors(truth, result.true_hits, result.reverse_pixels, mesh, camera);
    result.nearest.reverse = distribution_of(result.nearest.reverse_px);
  }
  result.topology = topology_of(truth, surface, edges, options.most_listed);
  result.topology.overlapped_samples = result.samples.overlapped;
}

// What any picture has; `judged` is the drawn one without what is set aside.
void measure_picture(AuditResult& result, const HeightfieldTruth& truth, const HitImage& judged,
                     const Camera& camera, const AuditOptions& options) {
  result.pixels = vertical_errors(truth, judged, camera);
  result.vertical = distribution_of(result.pixels.vertical_px);
  result.depth = distribution_of(depth_errors(result.true_hits, judged));
  if (!options.nearest) return;
  result.nearest.forward_px = forward_nearest_errors(truth, judged, result.pixels, camera);
  result.nearest.forward = distribution_of(result.nearest.forward_px);
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::Held:
      return "held";
    case Verdict::Broken:
      return "broken";
    case Verdict::None:
      return "none";
  }
  return "?";
}

std::optional<double> ClaimResult::tightness() const {
  if (!is_measured) return std::nullopt;
  if (measured > 0.0) return claim.bound / measured;
  if (claim.bound > 0.0) return kInfinity;
  return std::nullopt;
}

Verdict AuditResult::verdict() const {
  if (patch_claims_broken > 0 || !registration.agrees) return Verdict::Broken;
  for (const ClaimResult& claim : claims) {
    if (claim.is_broken()) return Verdict::Broken;
  }
  return no_verdict.empty() ? Verdict::Held : Verdict::None;
}

AuditResult audit_picture(const HeightfieldTruth& truth, HitImage true_hits,
                          const DrawnSurface& surface, HitImage drawn, const Camera& camera,
                          const AuditOptions& options) {
  require_consistent(true_hits, surface, drawn, camera);
  Stopwatch watch;
  AuditResult result;
  Band band = options.band;  // a silhouette may move by what the surface does
  band.metres = std::max(band.metres, surface.out_of_reach_m);
  result.cost = surface.cost;
  result.true_hits = std::move(true_hits);
  result.drawn = std::move(drawn);
  result.of_mesh = surface.mesh != nullptr;
  if (result.of_mesh) {
    measure_mesh(result, truth, surface, camera, options);
    measure_picture(result, truth, result.drawn, camera, options);
  } else {
    result.of_solid = surface.is_solid;
    if (surface.is_solid) {
      result.set_aside = rays_below_ground(truth, result.true_hits, result.drawn, camera, band);
      result.pixels_set_aside =
          std::count(result.set_aside.begin(), result.set_aside.end(), std::uint8_t{1});
      measure_picture(result, truth, without(result.drawn, result.set_aside), camera, options);
    } else {
      measure_picture(result, truth, result.drawn, camera, options);
    }
  }
  result.coverage =
      coverage_of(truth, result.true_hits, result.drawn, camera, surface, band, result.set_aside);
  result.registration = registration_of(surface.mesh.get(), result.drawn, camera);
  check_claims(result, truth, surface, camera, options);
  result.times.measure_s = watch.lap_s();
  return result;
}

AuditResult audit_surface(const HeightfieldTruth& truth, const DrawnSurface& surface,
                          const Camera& camera, const AuditOptions& options) {
  return audit_frame(truth, surface, camera, options);
}

}  // namespace plumb::audit
