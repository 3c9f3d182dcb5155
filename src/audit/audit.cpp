#include "audit/audit.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "audit/claim_check.h"
#include "core/check.h"
#include "core/parallel.h"
#include "raster/rasteriser.h"
#include "reference/heightfield_nearest.h"
#include "reference/mesh_nearest.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// |proj(q) - proj(p)| in pixels, both in the camera's coordinates; +inf if one is not before the
// eye.
double apart_on_screen(const Camera& camera, const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec3 a = to_view(camera, p), b = to_view(camera, q);
  if (!(a.z > 0.0) || !(b.z > 0.0)) return kInfinity;
  const glm::dvec2 d = view_to_pixel(camera, a) - view_to_pixel(camera, b);
  return std::sqrt(glm::dot(d, d));
}

// From each drawn point to the nearest of the truth, which is no farther than the truth above or
// below it.
std::vector<float> forward_nearest(const HeightfieldTruth& truth, const HitImage& drawn,
                                   const PixelErrors& vertical, const Camera& local) {
  std::vector<float> errors(drawn.size(), kNothing);
  parallel_for(static_cast<std::int64_t>(drawn.size()), 256, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (!drawn.hit(pixel)) return;
    const double radius = std::abs(vertical.vertical_m[pixel]);
    errors[pixel] = 0.0f;
    if (radius <= truth.slack_m) return;
    const glm::dvec3 point = local.eye_m + drawn.from_eye_m[pixel];
    // The map is kept in float32; the radius grows by its rounding.
    const reference::NearestPoint nearest = reference::nearest_on_heightfield(
        truth.field(), truth.diagonal(), truth.caster.pyramid(), point, radius * (1.0 + 1e-6));
    errors[pixel] =
        static_cast<float>(nearest ? apart_on_screen(local, point, nearest.point_m) : kInfinity);
  });
  return errors;
}

// And from each point of the truth to the nearest of the drawn mesh, which is only asked where they
// differ.
std::vector<float> reverse_nearest(const HeightfieldTruth& truth, const HitImage& true_hits,
                                   const PixelErrors& vertical, const TriangleMesh& mesh,
                                   const Camera& local) {
  std::vector<float> errors(true_hits.size(), kNothing);
  std::vector<std::size_t> asked;
  for (std::size_t pixel = 0; pixel < true_hits.size(); ++pixel) {
    if (!true_hits.hit(pixel)) continue;
    errors[pixel] = 0.0f;
    if (!(std::abs(vertical.vertical_m[pixel]) <= truth.slack_m)) asked.push_back(pixel);
  }
  if (asked.empty()) return errors;
  if (mesh.triangles.empty()) {
    for (const std::size_t pixel : asked) errors[pixel] = std::numeric_limits<float>::infinity();
    return errors;
  }
  const reference::MeshNearest nearest(mesh);
  const glm::dvec3 shift = mesh.origin_m - truth.field().world_origin_m();
  parallel_for(static_cast<std::int64_t>(asked.size()), 256, [&](std::int64_t k) {
    const std::size_t pixel = asked[static_cast<std::size_t>(k)];
    const glm::dvec3 point = local.eye_m + true_hits.from_eye_m[pixel];
    const double radius =
        std::abs(static_cast<double>(vertical.vertical_m[pixel])) * (1.0 + 1e-6) + truth.slack_m;
    const reference::NearestPoint found = nearest.nearest(point - shift, radius);
    errors[pixel] = static_cast<float>(found ? apart_on_screen(local, point, found.point_m + shift)
                                             : kInfinity);
  });
  return errors;
}

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
  const auto start = std::chrono::steady_clock::now();
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  AuditResult result;
  result.cost = surface.cost;
  result.true_hits = std::move(true_hits);
  result.drawn = std::move(drawn);
  result.samples = sample_errors(truth, result.true_hits, surface, camera);
  result.edges = edge_errors(truth, surface, camera);
  result.pixels = vertical_errors(truth, result.drawn, camera);
  result.reverse_pixels = reverse_vertical_errors(truth, result.true_hits, *surface.mesh, camera);
  result.vertical = distribution_of(result.pixels.vertical_px);
  result.reverse_vertical = distribution_of(result.reverse_pixels.vertical_px);
  result.depth = distribution_of(depth_errors(result.true_hits, result.drawn));
  result.normal_deg =
      distribution_of(normal_errors_deg(truth, result.true_hits, *surface.mesh, result.drawn));
  if (options.nearest) {
    result.nearest.forward_px = forward_nearest(truth, result.drawn, result.pixels, local);
    result.nearest.forward = distribution_of(result.nearest.forward_px);
    result.nearest.reverse = distribution_of(
        reverse_nearest(truth, result.true_hits, result.reverse_pixels, *surface.mesh, local));
  }
  result.coverage =
      coverage_of(truth, result.true_hits, result.drawn, camera, surface, options.band);
  result.registration = registration_of(*surface.mesh, result.drawn, camera);
  result.topology = topology_of(truth, surface, options.most_listed);
  result.topology.overlapped_samples = result.samples.overlapped;
  check_claims(result, truth, surface, camera, options);
  result.times.measure_s = seconds_since(start);
  return result;
}

AuditResult audit_surface(const HeightfieldTruth& truth, const DrawnSurface& surface,
                          const Camera& camera, const AuditOptions& options) {
  require(surface.mesh != nullptr, "a drawn surface needs a mesh");
  auto start = std::chrono::steady_clock::now();
  HitImage true_hits = truth.caster.cast_frame(camera);
  const double truth_s = seconds_since(start);
  start = std::chrono::steady_clock::now();
  raster::RasterResult raster = raster::rasterise(*surface.mesh, camera);
  const double raster_s = seconds_since(start);
  AuditResult result =
      audit_picture(truth, std::move(true_hits), surface, std::move(raster.image), camera, options);
  result.cost.fragments = raster.fragments;
  result.times.truth_s = truth_s;
  result.times.raster_s = raster_s;
  return result;
}

}  // namespace plumb::audit
