#include "terrain/path_presets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/reproducible_math.h"
#include "terrain/sight.h"

namespace plumb::terrain {
namespace {

constexpr int kMostFrames = 100000;
constexpr double kFlownPart = 0.5;    // of the ground ahead
constexpr double kNearestPart = 0.5;  // of the distance to the target

/// How far it is from `place` along `direction` to the border of the terrain.
double way_to_border_m(const Box& box, const glm::dvec2& place, const glm::dvec2& direction) {
  double way = std::numeric_limits<double>::infinity();
  for (const int axis : {0, 1}) {
    if (direction[axis] == 0.0) continue;
    const double border = direction[axis] > 0.0 ? box.high[axis] : box.low[axis];
    way = std::min(way, (border - place[axis]) / direction[axis]);
  }
  return std::isfinite(way) ? std::max(way, 0.0) : 0.0;
}

/// The highest ground below a level way, looked for at every half of a spacing.
double highest_ground_m(const Heightfield& field, const glm::dvec2& from,
                        const glm::dvec2& direction, double way_m) {
  const double step_m = 0.5 * std::min(field.dx_m, field.dy_m);
  double highest = -std::numeric_limits<double>::infinity();
  for (std::int64_t k = 0; static_cast<double>(k) * step_m <= way_m; ++k) {
    const glm::dvec2 place = from + static_cast<double>(k) * step_m * direction;
    const double ground = ground_height_m(field, place.x, place.y);
    if (ground > highest) highest = ground;
  }
  return highest;
}

LookAt flown(const Heightfield& field, LookAt view, double part) {
  const Box box = bounds(field);
  const glm::dvec3 eye = view.eye_m - field.world_origin_m(), ahead = view.target_m - view.eye_m;
  const double length = std::sqrt(ahead.x * ahead.x + ahead.y * ahead.y);
  if (box.empty() || !(length > 0.0)) return view;
  const glm::dvec2 direction{ahead.x / length, ahead.y / length};
  const double way_m = kFlownPart * way_to_border_m(box, {eye.x, eye.y}, direction);
  const double clearance_m = 10.0 * view.near_m;  // as that of the view
  const double above_m =
      highest_ground_m(field, {eye.x, eye.y}, direction, way_m) + clearance_m - eye.z;
  const glm::dvec3 moved{part * way_m * direction.x, part * way_m * direction.y,
                         std::max(above_m, 0.0)};
  view.eye_m += moved;
  view.target_m += moved;
  return view;
}

LookAt nearer(LookAt view, double part) {
  const double left = reproducible_exp(part * reproducible_log(kNearestPart));
  view.eye_m = view.target_m + left * (view.eye_m - view.target_m);
  view.near_m *= left;
  return view;
}

}  // namespace

const std::vector<PresetHelp>& path_preset_help() {
  static const std::vector<PresetHelp> help = {
      {"flyover", "level and straight ahead from the oblique view, over half of the ground"},
      {"zoom", "from the oblique view towards its target, to half of the distance"}};
  return help;
}

bool is_path_preset(const std::string& name) {
  return std::any_of(path_preset_help().begin(), path_preset_help().end(),
                     [&](const PresetHelp& preset) { return preset.name == name; });
}

LookAt path_preset_camera(const Heightfield& field, const std::string& name, int frame, int frames,
                          int width_px, int height_px, double fov_y_deg) {
  require(frames >= 1 && frames <= kMostFrames, "a path has 1 to {} frames, got {}", kMostFrames,
          frames);
  require(frame >= 1 && frame <= frames, "frame must be 1 to {}, got {}", frames, frame);
  if (!is_path_preset(name)) {
    std::string known;
    for (const PresetHelp& preset : path_preset_help())
      known += (known.empty() ? "" : ", ") + preset.name;
    input_error("camera path '{}': expected {}", name, known);
  }
  const LookAt view = preset_camera(field, "oblique", width_px, height_px, fov_y_deg);
  const double part = frames == 1 ? 0.0 : static_cast<double>(frame - 1) / (frames - 1);
  return name == "flyover" ? flown(field, view, part) : nearer(view, part);
}

}  // namespace plumb::terrain
