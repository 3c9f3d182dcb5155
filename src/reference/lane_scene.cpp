#include "reference/lane_scene.h"

#include <algorithm>
#include <limits>

#include "reference/careful_walk.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr std::size_t kMostLaneSamples = 0x7fffffff;  // lanes count samples in 32 bits

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

}  // namespace

LaneScene lane_scene(const Heightfield& field, Diagonal diagonal, const HeightPyramid& pyramid,
                     const Ray& ray) {
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
  scene.cut = cut_of(diagonal);
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

void walk_lanes(const Heightfield& field, const LaneScene& scene, LaneRays& rays) {
  if (field.heights_m.size() <= kMostLaneSamples) {
    lane_walk(instruction_set())(scene, rays);
  } else {
    std::fill_n(rays.undecided, rays.count, true);
    std::fill_n(rays.t, rays.count, -std::numeric_limits<double>::infinity());
  }
}

}  // namespace plumb::reference
