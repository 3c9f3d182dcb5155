#include "audit/audit.h"

#include <cmath>
#include <limits>
#include <utility>

#include "audit/claim_check.h"
#include "audit/nearest_error.h"
#include "core/check.h"
#include "core/stopwatch.h"
#include "raster/rasteriser.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void require_consistent(const HitImage& true_hits, const DrawnSurface& surface,
                        const HitImage& drawn, const Camera& camera) {
  require(surface.mesh != nullptr, "a drawn surface needs a mesh");
  for (const HitImage* image : {&true_hits, &drawn}) {
    require(image->width_px == camera.width_px && image->height_px == camera.height_px,
            "a picture must be {} x {} pixels as the camera says, got {} x {}", camera.width_px,
            camera.height_px, image->width_px, image->height_px);
  }
  for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel) {
    if (drawn.hit(pixel) && drawn.primitive[pixel] >= surface.mesh->triangles.size()) {
      throw std::invalid_argument("a picture must name triangles of the surface's mesh");
    }
  }
  require(
      surface.triangle_lod.empty() || surface.triangle_lod.size() == surface.mesh->triangles.size(),
      "triangle_lod must have an entry for each of {} triangles, got {}",
      surface.mesh->triangles.size(), surface.triangle_lod.size());
}

}  // namespace

std::optional<double> ClaimResult::tightness() const {
  if (measured > 0.0) return claim.bound / measured;
  if (claim.bound > 0.0) return kInfinity;
  return std::nullopt;
}

bool AuditResult::holds() const {
  if (patch_claims_broken > 0 || !registration.agrees) return false;
  for (const ClaimResult& claim : claims) {
    if (!claim.holds) return false;
  }
  return true;
}

AuditResult audit_picture(const HeightfieldTruth& truth, HitImage true_hits,
                          const DrawnSurface& surface, HitImage drawn, const Camera& camera,
                          const AuditOptions& options) {
  require_consistent(true_hits, surface, drawn, camera);
  Stopwatch watch;
  AuditResult result;
  result.cost = surface.cost;
  result.true_hits = std::move(true_hits);
  result.drawn = std::move(drawn);
  result.samples = sample_errors(truth, result.true_hits, surface, camera);
  const MeshEdges edges(*surface.mesh);
  result.edges = edge_errors(truth, *surface.mesh, edges, camera);
  result.pixels = vertical_errors(truth, result.drawn, camera);
  result.reverse_pixels = reverse_vertical_errors(truth, result.true_hits, *surface.mesh, camera);
  result.vertical = distribution_of(result.pixels.vertical_px);
  result.reverse_vertical = distribution_of(result.reverse_pixels.vertical_px);
  result.depth = distribution_of(depth_errors(result.true_hits, result.drawn));
  result.normal_deg =
      distribution_of(normal_errors_deg(truth, result.true_hits, *surface.mesh, result.drawn));
  if (options.nearest) {
    result.nearest.forward_px = forward_nearest_errors(truth, result.drawn, result.pixels, camera);
    result.nearest.forward = distribution_of(result.nearest.forward_px);
    result.nearest.reverse = distribution_of(reverse_nearest_errors(
        truth, result.true_hits, result.reverse_pixels, *surface.mesh, camera));
  }
  result.coverage =
      coverage_of(truth, result.true_hits, result.drawn, camera, surface, options.band);
  result.registration = registration_of(*surface.mesh, result.drawn, camera);
  result.topology = topology_of(truth, surface, edges, options.most_listed);
  result.topology.overlapped_samples = result.samples.overlapped;
  check_claims(result, truth, surface, camera, options);
  result.times.measure_s = watch.lap_s();
  return result;
}

AuditResult audit_surface(const HeightfieldTruth& truth, const DrawnSurface& surface,
                          const Camera& camera, const AuditOptions& options) {
  require(surface.mesh != nullptr, "a drawn surface needs a mesh");
  Stopwatch watch;
  HitImage true_hits = truth.caster.cast_frame(camera);
  const double truth_s = watch.lap_s();
  raster::RasterResult raster =
      raster::rasterise(*surface.mesh, camera, {.runs = surface.usable_runs()});
  const double raster_s = watch.lap_s();
  AuditResult result =
      audit_picture(truth, std::move(true_hits), surface, std::move(raster.image), camera, options);
  result.cost.fragments = raster.fragments;
  result.times.truth_s = truth_s;
  result.times.raster_s = raster_s;
  return result;
}

}  // namespace plumb::audit
