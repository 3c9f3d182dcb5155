#include "audit/nearest_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include "audit/apart_on_screen.h"
#include "audit/pixel_tile.h"
#include "core/parallel.h"
#include "reference/heightfield_nearest.h"
#include "reference/mesh_nearest.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

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
  const auto is_off = [&](std::size_t pixel) {
    return true_hits.hit(pixel) && !(std::abs(vertical.vertical_m[pixel]) <= truth.slack_m);
  };
  const auto pixels = static_cast<std::int64_t>(true_hits.size());
  const bool any = parallel_ordered_reduce(
      pixels, 4096, false,
      [&](std::int64_t begin, std::int64_t end, bool found) {
        for (std::int64_t k = begin; k < end && !found; ++k)
          found = is_off(static_cast<std::size_t>(k));
        return found;
      },
      std::logical_or<>());
  std::optional<reference::MeshNearest> nearest;
  if (any && !mesh.triangles.empty()) nearest.emplace(mesh);
  const glm::dvec3 shift = mesh.origin_m - truth.field().world_origin_m();
  const auto ask = [&](const PixelTile& tile) {
    std::array<std::size_t, PixelTile::kPixels> asked;
    std::array<glm::dvec3, PixelTile::kPixels> points;
    std::array<reference::NearestQuery, PixelTile::kPixels> queries;
    std::array<reference::NearestPoint, PixelTile::kPixels> found;
    std::size_t count = 0;
    tile.for_each([&](std::size_t pixel) {
      if (true_hits.hit(pixel)) errors[pixel] = 0.0f;
      if (!is_off(pixel)) return;
      errors[pixel] = std::numeric_limits<float>::infinity();
      const double radius =
          std::abs(static_cast<double>(vertical.vertical_m[pixel])) * (1.0 + 1e-6) + truth.slack_m;
      points[count] = local.eye_m + true_hits.from_eye_m[pixel];
      queries[count] = {points[count] - shift, radius, vertical.triangle[pixel]};
      asked[count++] = pixel;
    });
    if (!nearest) return;
    nearest->nearest_together(std::span(queries).first(count), std::span(found).first(count));
    for (std::size_t k = 0; k < count; ++k) {
      if (!found[k]) continue;
      errors[asked[k]] =
          static_cast<float>(apart_on_screen(local, points[k], found[k].point_m + shift));
    }
  };
  for_each_tile(true_hits, ask);
  return errors;
}

}  // namespace plumb::audit
