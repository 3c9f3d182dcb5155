#include "audit/nearest_error.h"

#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "reference/heightfield_nearest.h"
#include "reference/mesh_nearest.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

// |proj(q) - proj(p)| in pixels, both in the camera's coordinates; +inf if one is not before the
// eye.
double apart_on_screen(const Camera& camera, const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec3 a = to_view(camera, p), b = to_view(camera, q);
  if (!(a.z > 0.0) || !(b.z > 0.0)) return kInfinity;
  const glm::dvec2 d = view_to_pixel(camera, a) - view_to_pixel(camera, b);
  return std::sqrt(glm::dot(d, d));
}

}  // namespace

std::vector<float> forward_nearest_errors(const HeightfieldTruth& truth, const HitImage& drawn,
                                          const PixelErrors& vertical, const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
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

std::vector<float> reverse_nearest_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                                          const ReversePixelErrors& vertical,
                                          const TriangleMesh& mesh, const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
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
    const reference::NearestPoint found =
        nearest.nearest(point - shift, radius, vertical.triangle[pixel]);
    errors[pixel] = static_cast<float>(found ? apart_on_screen(local, point, found.point_m + shift)
                                             : kInfinity);
  });
  return errors;
}

}  // namespace plumb::audit
