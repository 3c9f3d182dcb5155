#include "reference/pyramid_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/check.h"
#include "core/parallel.h"
#include "reference/beam_start.h"
#include "reference/careful_walk.h"
#include "reference/lane_scene.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr int kTile = 16;  // pixels along the side of a piece of work: what LaneRays holds
static_assert(kTile * kTile <= LaneRays::kMost);

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

PyramidCaster::PyramidCaster(const Heightfield& field, Diagonal diagonal)
    : field_(field), diagonal_(diagonal), pyramid_((terrain::require_valid(field), field)) {}

RayHit PyramidCaster::cast(const Ray& ray) const {
  require(finite(ray.origin_m) && finite(ray.direction),
          "a ray's origin and direction must be finite");
  require(glm::dot(ray.direction, ray.direction) > 0.0, "a ray's direction must not be zero");
  require(ray.t_min >= 0.0, "t_min must be >= 0, got {}", ray.t_min);
  return walk_carefully(field_, diagonal_, pyramid_, ray);
}

Ray PyramidCaster::camera_ray(const Camera& camera, double x_px, double y_px) const {
  return {camera.eye_m - field_.world_origin_m(), ray_direction(camera, x_px, y_px), camera.near_m,
          camera.far_m};
}

namespace {

// Pixels [x0, x1) x [y0, y1).
struct PixelRect {
  int x0, y0, x1, y1;
};

void set_directions(LaneRays& rays, const Camera& camera, const PixelRect& rect) {
  rays.count = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      const glm::dvec3 direction = ray_direction(camera, x + 0.5, y + 0.5);
      rays.direction_x[rays.count] = direction.x;
      rays.direction_y[rays.count] = direction.y;
      rays.direction_z[rays.count] = direction.z;
      ++rays.count;
    }
  }
}

}  // namespace

void PyramidCaster::cast_rect(const Camera& camera, const LaneScene& scene, LaneRays& rays, int x0,
                              int y0, HitImage& image) const {
  const PixelRect rect{x0, y0, std::min(x0 + kTile, camera.width_px),
                       std::min(y0 + kTile, camera.height_px)};
  const BeamStart start = beam_start(field_, pyramid_,
                                     camera_beam(camera, field_.world_origin_m(), rect.x0 + 0.5,
                                                 rect.y0 + 0.5, rect.x1 - 0.5, rect.y1 - 0.5));
  if (!(start.t < std::numeric_limits<double>::infinity())) return;
  set_directions(rays, camera, rect);
  rays.t_begin = start.t;
  rays.begin_level = std::min(start.level, scene.top_level);
  walk_lanes(field_, scene, rays);
  int k = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x, ++k) {
      RayHit hit{rays.t[k], rays.triangle[k]};
      if (rays.undecided[k]) {
        hit = walk_carefully(field_, diagonal_, pyramid_, camera_ray(camera, x + 0.5, y + 0.5),
                             rays.t[k]);
      }
      if (!hit) continue;
      const std::size_t pixel = image.index(x, y);
      const glm::dvec3 direction{rays.direction_x[k], rays.direction_y[k], rays.direction_z[k]};
      image.depth_m[pixel] = hit.t;
      image.from_eye_m[pixel] = hit.t * direction;
      image.primitive[pixel] = hit.triangle;
    }
  }
}

HitImage PyramidCaster::cast_frame(const Camera& camera) const {
  HitImage image(camera.width_px, camera.height_px);
  if (pyramid_.root().empty()) return image;
  const LaneScene scene = lane_scene(field_, diagonal_, pyramid_, camera_ray(camera, 0.5, 0.5));
  const int tiles_x = (camera.width_px + kTile - 1) / kTile,
            tiles_y = (camera.height_px + kTile - 1) / kTile;
  parallel_for(tiles_y, 1, [&](std::int64_t row) {
    const auto rays = std::make_unique<LaneRays>();
    for (int tile = 0; tile < tiles_x; ++tile)
      cast_rect(camera, scene, *rays, tile * kTile, static_cast<int>(row) * kTile, image);
  });
  return image;
}

}  // namespace plumb::reference
