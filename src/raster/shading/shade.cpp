#include "raster/shading/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "image/srgb.h"

namespace plumb::raster {
namespace {

constexpr std::int64_t kGrain = 16384;  // pixels

struct Stop {
  double share;
  std::array<std::uint8_t, 3> srgb;
};

// Lowland green, meadow, straw, brown, rock, snow.
constexpr std::array<Stop, 6> kStops{{{0.00, {58, 122, 74}},
                                      {0.20, {132, 168, 92}},
                                      {0.42, {214, 198, 132}},
                                      {0.65, {160, 116, 80}},
                                      {0.84, {176, 164, 156}},
                                      {1.00, {250, 250, 252}}}};

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 0.0 ? v / length : glm::dvec3(0.0);
}

glm::dvec3 mix(const glm::dvec3& a, const glm::dvec3& b, double t) { return a + (b - a) * t; }

glm::dvec3 pixel_of(const image::ColourImage& picture, int x, int y) {
  const std::size_t k = picture.index(std::clamp(x, 0, picture.width_px - 1),
                                      std::clamp(y, 0, picture.height_px - 1));
  return {picture.r[k], picture.g[k], picture.b[k]};
}

// Bilinear between pixel centres, the border repeated outside.
glm::dvec3 drape_colour(const Drape& drape, const glm::dvec3& world_m) {
  const image::ColourImage& picture = *drape.picture;
  const glm::dvec2 share = (glm::dvec2(world_m) - drape.low_m) / (drape.high_m - drape.low_m);
  const double x = std::clamp(share.x, 0.0, 1.0) * picture.width_px - 0.5;
  const double y = (1.0 - std::clamp(share.y, 0.0, 1.0)) * picture.height_px - 0.5;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const int i = static_cast<int>(x0), j = static_cast<int>(y0);
  return mix(mix(pixel_of(picture, i, j), pixel_of(picture, i + 1, j), x - x0),
             mix(pixel_of(picture, i, j + 1), pixel_of(picture, i + 1, j + 1), x - x0), y - y0);
}

void require_usable(const HitImage& hits, const Camera& camera, std::span<const glm::dvec3> normals,
                    const ShadeOptions& options) {
  require(hits.width_px == camera.width_px && hits.height_px == camera.height_px,
          "a picture of {} x {} pixels is not of the camera's {} x {}", hits.width_px,
          hits.height_px, camera.width_px, camera.height_px);
  require(normals.size() == hits.size(), "normals must have one entry a pixel, {}, got {}",
          hits.size(), normals.size());
  require(glm::dot(options.light.towards, options.light.towards) > 0.0,
          "a light's direction must not be zero");
  require(options.light.ambient >= 0.0 && options.light.ambient <= 1.0,
          "ambient must lie in [0, 1], got {}", options.light.ambient);
  require(options.haze_m > 0.0, "haze_m must be > 0, got {}", options.haze_m);
  require(options.albedo.empty() || options.albedo.size() == hits.size(),
          "there must be an albedo for each of {} pixels, got {}", hits.size(),
          options.albedo.size());
  const Drape& drape = options.drape;
  if (drape.picture == nullptr) return;
  require(drape.picture->width_px >= 1 && drape.picture->height_px >= 1,
          "a draped picture must be at least 1 x 1 pixels");
  require(drape.low_m.x < drape.high_m.x && drape.low_m.y < drape.high_m.y,
          "a draped picture's high corner must lie above its low one");
}

struct Shader {
  const Camera& camera;
  const ShadeOptions& options;
  glm::dvec3 light;  // unit

  glm::dvec3 surface(const glm::dvec3& from_eye_m, const glm::dvec3& normal, double depth_m) const {
    return lit(ground(camera.eye_m + from_eye_m), from_eye_m, normal, depth_m);
  }

  glm::dvec3 lit(const glm::dvec3& albedo, const glm::dvec3& from_eye_m, glm::dvec3 normal,
                 double depth_m) const {
    if (options.two_sided && glm::dot(normal, from_eye_m) > 0.0)
      normal = -normal;  // the side that is seen
    const double sun = std::max(0.0, glm::dot(normal, light));
    const double sky = 0.5 + 0.5 * normal.z;
    const double ambient = options.light.ambient;
    const glm::dvec3 colour = albedo * (ambient * sky + (1.0 - ambient) * sun);
    return mix(colour, options.sky.horizon, 1.0 - 1.0 / (1.0 + depth_m / options.haze_m));
  }

  glm::dvec3 ground(const glm::dvec3& world_m) const {
    if (options.drape.picture != nullptr) return drape_colour(options.drape, world_m);
    const double range_m = options.high_m - options.low_m;
    return hypsometric_tint(range_m > 0.0 ? (world_m.z - options.low_m) / range_m : 0.0);
  }
};

}  // namespace

glm::dvec3 hypsometric_tint(double share) {
  const auto colour = [](const Stop& stop) {
    return glm::dvec3(image::srgb8_to_linear(stop.srgb[0]), image::srgb8_to_linear(stop.srgb[1]),
                      image::srgb8_to_linear(stop.srgb[2]));
  };
  if (!(share > 0.0)) return colour(kStops.front());
  for (std::size_t k = 1; k < kStops.size(); ++k) {
    if (share > kStops[k].share) continue;
    const double span = kStops[k].share - kStops[k - 1].share;
    return mix(colour(kStops[k - 1]), colour(kStops[k]), (share - kStops[k - 1].share) / span);
  }
  return colour(kStops.back());
}

glm::dvec3 sky_colour(const Sky& sky, const glm::dvec3& direction) {
  const double sine = unit_or_zero(direction).z;
  if (sine < 0.0) return sky.below;
  // The square root makes the change quick beside the horizon, as in a clear sky.
  return mix(sky.horizon, sky.zenith, std::sqrt(std::min(1.0, sine)));
}

std::vector<glm::dvec3> flat_normals(const TriangleMesh& mesh, const HitImage& hits) {
  for (std::size_t k = 0; k < hits.size(); ++k) {
    require(!hits.hit(k) || hits.primitive[k] < mesh.triangles.size(),
            "a hit names triangle {}, the mesh has {}", hits.primitive[k], mesh.triangles.size());
  }
  std::vector<glm::dvec3> normals(hits.size(), glm::dvec3(0.0));
  parallel_for(static_cast<std::int64_t>(hits.size()), kGrain, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    if (!hits.hit(k)) return;
    const Triangle& t = mesh.triangles[hits.primitive[k]];
    normals[k] = unit_or_zero(
        area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]));
  });
  return normals;
}

glm::dvec3 surface_colour(const Camera& camera, const glm::dvec3& from_eye_m,
                          const glm::dvec3& normal, double depth_m, const ShadeOptions& options) {
  const Shader shader{camera, options, unit_or_zero(options.light.towards)};
  return shader.surface(from_eye_m, normal, depth_m);
}

image::ColourImage shade(const HitImage& hits, const Camera& camera,
                         std::span<const glm::dvec3> normals, const ShadeOptions& options) {
  require_usable(hits, camera, normals, options);
  const Shader shader{camera, options, unit_or_zero(options.light.towards)};
  image::ColourImage result(hits.width_px, hits.height_px);
  parallel_for(static_cast<std::int64_t>(hits.size()), kGrain, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const int x = static_cast<int>(i % hits.width_px), y = static_cast<int>(i / hits.width_px);
    const glm::dvec3 colour =
        !hits.hit(k) ? sky_colour(options.sky, ray_direction(camera, x + 0.5, y + 0.5))
        : options.albedo.empty()
            ? shader.surface(hits.from_eye_m[k], normals[k], hits.depth_m[k])
            : shader.lit(options.albedo[k], hits.from_eye_m[k], normals[k], hits.depth_m[k]);
    result.r[k] = static_cast<float>(colour.x);
    result.g[k] = static_cast<float>(colour.y);
    result.b[k] = static_cast<float>(colour.z);
  });
  return result;
}

}  // namespace plumb::raster
