#include "audit/pixel_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr std::int64_t kGrain = 4096;

struct Worst {
  double error = -1.0;
  std::int64_t pixel = -1;
  double pixels_per_metre = 0.0;
};

Worst worse(const Worst& a, const Worst& b) {
  Worst result = b.error > a.error ? b : a;  // equal: the first
  result.pixels_per_metre = std::max(a.pixels_per_metre, b.pixels_per_metre);
  return result;
}

// measure(pixel, vertical_m) -> error in pixels and the point's pixels per metre, for pixels where
// shown(pixel).
template <class Shown, class Measure>
PixelErrors measure_pixels(std::size_t size, const Shown& shown, const Measure& measure) {
  PixelErrors errors;
  errors.vertical_px.assign(size, kNothing);
  errors.vertical_m.assign(size, kNothing);
  const Worst worst = parallel_ordered_reduce(
      static_cast<std::int64_t>(size), kGrain, Worst{},
      [&](std::int64_t begin, std::int64_t end, Worst found) {
        for (std::int64_t k = begin; k < end; ++k) {
          const auto pixel = static_cast<std::size_t>(k);
          if (!shown(pixel)) continue;
          double vertical_m = 0.0;
          Worst here;
          here.pixel = k;
          here.error = measure(pixel, vertical_m, here.pixels_per_metre);
          errors.vertical_px[pixel] = static_cast<float>(here.error);
          errors.vertical_m[pixel] = static_cast<float>(vertical_m);
          found = worse(found, here);
        }
        return found;
      },
      worse);
  errors.max_vertical_px = std::max(0.0, worst.error);
  errors.worst_pixel = worst.pixel;
  errors.pixels_per_metre = worst.pixels_per_metre;
  return errors;
}

}  // namespace

PixelErrors vertical_errors(const HeightfieldTruth& truth, const HitImage& drawn,
                            const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  return measure_pixels(
      drawn.size(), [&](std::size_t pixel) { return drawn.hit(pixel); },
      [&](std::size_t pixel, double& vertical_m, double& pixels_per_metre) {
        const glm::dvec3 point = local.eye_m + drawn.from_eye_m[pixel];
        const double height = truth.height_at(point.x, point.y);
        vertical_m = std::isnan(height) ? kInfinity : point.z - height;
        if (std::isnan(height)) return kInfinity;
        const double small = 1e-6 * drawn.depth_m[pixel];
        pixels_per_metre = screen_displacement_px(local, point, kUp, small) / small;
        return screen_displacement_px(local, point, kUp, height - point.z);
      });
}

PixelErrors reverse_vertical_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                                    const TriangleMesh& mesh, const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  std::vector<glm::dvec3> places;
  std::vector<std::uint32_t> place_of(true_hits.size(), kNoPrimitive);
  for (std::size_t pixel = 0; pixel < true_hits.size(); ++pixel) {
    if (!true_hits.hit(pixel)) continue;
    place_of[pixel] = static_cast<std::uint32_t>(places.size());
    places.push_back(local.eye_m + true_hits.from_eye_m[pixel]);
  }
  const std::vector<Deviation> found = deviation_at(truth.field(), mesh, places);
  return measure_pixels(
      true_hits.size(), [&](std::size_t pixel) { return true_hits.hit(pixel); },
      [&](std::size_t pixel, double& vertical_m, double& pixels_per_metre) {
        const Deviation& there = found[place_of[pixel]];
        vertical_m = there.covered() ? there.delta_m : kInfinity;
        if (!there.covered()) return kInfinity;
        const glm::dvec3& point = places[place_of[pixel]];
        const double small = 1e-6 * true_hits.depth_m[pixel];
        pixels_per_metre = screen_displacement_px(local, point, kUp, small) / small;
        return screen_displacement_px(local, point, kUp, there.delta_m);
      });
}

std::vector<float> depth_errors(const HitImage& true_hits, const HitImage& drawn) {
  std::vector<float> errors(drawn.size(), kNothing);
  parallel_for(static_cast<std::int64_t>(drawn.size()), kGrain, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (!drawn.hit(pixel) || !true_hits.hit(pixel)) return;
    errors[pixel] = static_cast<float>(std::abs(drawn.depth_m[pixel] - true_hits.depth_m[pixel]) /
                                       true_hits.depth_m[pixel]);
  });
  return errors;
}

std::vector<float> normal_errors_deg(const HeightfieldTruth& truth, const HitImage& true_hits,
                                     const TriangleMesh& mesh, const HitImage& drawn) {
  std::vector<float> errors(drawn.size(), kNothing);
  parallel_for(static_cast<std::int64_t>(drawn.size()), kGrain, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (!drawn.hit(pixel) || !true_hits.hit(pixel)) return;
    const glm::dvec3 expected =
        reference::triangle_normal(truth.field(), truth.diagonal(), true_hits.primitive[pixel]);
    const Triangle& t = mesh.triangles[drawn.primitive[pixel]];
    glm::dvec3 normal =
        area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]);
    if (normal.z < 0.0) normal = -normal;  // a sheet has two sides
    const glm::dvec3 across = glm::cross(expected, normal);
    const double sine = std::sqrt(glm::dot(across, across));
    errors[pixel] =
        static_cast<float>(degrees(reproducible_atan2(sine, glm::dot(expected, normal))));
  });
  return errors;
}

}  // namespace plumb::audit
