#include "reference/pyramid_caster.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/check.h"
#include "core/parallel.h"
#include "reference/beam_start.h"
#include "reference/careful_walk.h"
#include "reference/lane_walk.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr int kTile = 16;  // pixels along the side of a piece of work: what LaneRays holds
constexpr std::size_t kMostLaneSamples = 0x7fffffff;  // lanes count samples in 32 bits
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

LaneScene::Cut cut_of(Diagonal diagonal) {
  switch (diagonal) {
    case Diagonal::Alternating:
      return LaneScene::Cut::Alternating;
    case Diagonal::Fixed:
      return LaneScene::Cut::Fixed;
    case Diagonal::Blocks8:
      return LaneScene::Cut::Blocks8;
  }
  return LaneScene::Cut::Fixed;
}

void set_heights(LaneScene& scene, const terrain::HeightGrid& heights,
                 const HeightPyramid& pyramid) {
  static_assert(sizeof(HeightRange) == 2 * sizeof(float));
  static_assert(sizeof(CodeRange) == 2 * sizeof(std::uint16_t));
  scene.heights = terrain::stored(heights);
  if (heights.is_coded()) {
    scene.range_codes = &pyramid.codes()->low;
  } else {
    scene.ranges = &pyramid.ranges()->low;
  }
}

LaneScene lane_scene(const PyramidCaster& caster, const Ray& ray) {
  const Heightfield& field = caster.field();
  const HeightPyramid& pyramid = caster.pyramid();
  const WalkLimits limits = walk_limits(field, pyramid, ray.origin_m);
  LaneScene scene{};
  set_heights(scene, field.heights_m, pyramid);
  scene.columns = field.columns();
  scene.cell_columns = field.cell_columns();
  scene.cell_rows = field.cell_rows();
  scene.top_level = std::min(pyramid.top_level(), LaneScene::kLevels - 1);
  scene.level_column[0] = 1.0;
  for (int level = 1; level <= scene.top_level; ++level) {
    const double cells = 1 << level;
    scene.level_begin[level] = static_cast<double>(pyramid.begin(level));
    scene.level_row[level] = pyramid.columns(level) / cells;
    scene.level_column[level] = 1.0 / cells;
  }
  scene.cut = cut_of(caster.diagonal());
  scene.dx_m = field.dx_m;
  scene.dy_m = field.dy_m;
  scene.u = ray.origin_m.x / field.dx_m;
  scene.v = ray.origin_m.y / field.dy_m;
  scene.z = ray.origin_m.z;
  scene.t_min = ray.t_min;
  scene.t_max = ray.t_max;
  scene.lowest = limits.lowest;
  scene.highest = limits.highest;
  scene.height_slack = limits.height_slack;
  scene.place_slack = limits.place_slack;
  return scene;
}

// Pixels [x0, x1) x [y0, y1).
struct PixelRect {
  int x0, y0, x1, y1;
};

// Directions are linear in the pixel's place: the corners bound them.
Beam beam_of(const PyramidCaster& caster, const Camera& camera, const PixelRect& rect) {
  const Ray ray = caster.camera_ray(camera, rect.x0 + 0.5, rect.y0 + 0.5);
  Beam beam{ray.origin_m, ray.direction, ray.direction, ray.t_min, ray.t_max};
  for (const double y : {rect.y0 + 0.5, rect.y1 - 0.5}) {
    for (const double x : {rect.x0 + 0.5, rect.x1 - 0.5}) {
      const glm::dvec3 direction = ray_direction(camera, x, y);
      beam.low = glm::min(beam.low, direction);
      beam.high = glm::max(beam.high, direction);
    }
  }
  // More than the roundings of a direction's three sums.
  const double slack = 1e-15;
  beam.low -= slack * (glm::abs(beam.low) + glm::abs(camera.forward) + 1.0);
  beam.high += slack * (glm::abs(beam.high) + glm::abs(camera.forward) + 1.0);
  return beam;
}

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
  const BeamStart start = beam_start(field_, pyramid_, beam_of(*this, camera, rect));
  if (!(start.t < std::numeric_limits<double>::infinity())) return;
  set_directions(rays, camera, rect);
  rays.t_begin = start.t;
  rays.begin_level = std::min(start.level, scene.top_level);
  if (field_.heights_m.size() <= kMostLaneSamples) {
    lane_walk(instruction_set())(scene, rays);
  } else {
    std::fill_n(rays.undecided, rays.count, true);
    std::fill_n(rays.t, rays.count, -std::numeric_limits<double>::infinity());
  }
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
  const LaneScene scene = lane_scene(*this, camera_ray(camera, 0.5, 0.5));
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
