#include "terrain/camera_presets.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "terrain/path_presets.h"
#include "terrain/preset_views.h"

namespace plumb::terrain {
namespace {

/// Turns the view halfway towards the ground under the eye until its middle meets ground.
std::optional<double> lower_to_ground(const Scene& scene, View& view) {
  auto hit = first_ground(*scene.field, scene.box, view.eye_m, forward_of(view));
  for (int halvings = 0; !hit && halvings < 12; ++halvings) {
    view.pitch = reproducible_tan((reproducible_atan(view.pitch) - kPi / 2.0) / 2.0);
    hit = first_ground(*scene.field, scene.box, view.eye_m, forward_of(view));
  }
  return hit;
}

LookAt look(const Scene& scene, View view, const LookAt& picture) {
  LookAt description = picture;
  const auto hit = lower_to_ground(scene, view);
  const double distance = hit && *hit > 0.0 ? *hit : std::max(scene.extent_m, scene.spacing_m);
  const glm::dvec3 origin = scene.field->world_origin_m();
  description.eye_m = origin + view.eye_m;
  description.target_m = origin + (view.eye_m + distance * forward_of(view));
  description.near_m = std::max(0.01, view.clearance_m / 10.0);
  return description;
}

/// Corners (x, y) of the samples that are not void; empty if all are.
Box solid_bounds(const Heightfield& field) {
  std::vector<Box> rows(static_cast<std::size_t>(field.rows()));
  parallel_for(field.rows(), 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    Box& box = rows[static_cast<std::size_t>(row)];
    int first = 0, last = field.columns() - 1;
    while (first <= last && field.is_void(first, j)) ++first;
    while (last > first && field.is_void(last, j)) --last;
    if (first > last) return;
    box.add({first * field.dx_m, j * field.dy_m, 0.0});
    box.add({last * field.dx_m, j * field.dy_m, 0.0});
  });
  Box all;
  for (const Box& box : rows) all.add(box);
  return all;
}

LookAt top(const Scene& scene, const std::vector<Stand>& stands, LookAt picture) {
  Box solid = solid_bounds(*scene.field);
  if (solid.empty()) solid.add({0.0, 0.0, 0.0});
  const double highest = scene.box.empty() ? 0.0 : scene.box.high.z;
  const double lowest = scene.box.empty() ? 0.0 : scene.box.low.z;
  glm::dvec2 middle{(solid.low.x + solid.high.x) / 2.0, (solid.low.y + solid.high.y) / 2.0};
  if (!stands.empty() && std::isnan(ground_height_m(*scene.field, middle.x, middle.y))) {
    const auto distance = [&](const Stand& stand) {
      const glm::dvec2 d = stand.place_m - middle;
      return d.x * d.x + d.y * d.y;
    };
    middle = std::min_element(stands.begin(), stands.end(), [&](const Stand& a, const Stand& b) {
               return distance(a) < distance(b);
             })->place_m;
  }
  const double half_x = std::max(solid.high.x - middle.x, middle.x - solid.low.x);
  const double half_y = std::max(solid.high.y - middle.y, middle.y - solid.low.y);
  constexpr double kMargin = 1.05;
  const double above = kMargin * std::max({half_x / scene.tan_half_fov_x,
                                           half_y / scene.tan_half_fov_y, scene.spacing_m});
  const glm::dvec3 origin = scene.field->world_origin_m();
  picture.eye_m = origin + glm::dvec3(middle, highest + above);
  picture.target_m = origin + glm::dvec3(middle, lowest);
  picture.up = {0.0, 1.0, 0.0};
  picture.near_m = std::max(0.01, above / 10.0);
  return picture;
}

/// Towards the first sample that is not void, or the middle, from the south and above.
LookAt look_at_a_sample(const Scene& scene, LookAt picture) {
  const Heightfield& field = *scene.field;
  glm::dvec3 target{scene.extent_m / 2.0, scene.extent_m / 2.0, 0.0};
  const auto columns = static_cast<std::int64_t>(field.columns());
  for (std::int64_t k = 0; k < columns * field.rows(); ++k) {
    const int i = static_cast<int>(k % columns), j = static_cast<int>(k / columns);
    if (field.is_void(i, j)) continue;
    target = {i * field.dx_m, j * field.dy_m, field.heights_m(i, j)};
    break;
  }
  const double away = 10.0 * scene.spacing_m;
  picture.target_m = field.world_origin_m() + target;
  picture.eye_m = picture.target_m + glm::dvec3(0.0, -away, away);
  picture.near_m = std::max(0.01, away / 10.0);
  return picture;
}

Scene scene_of(const Heightfield& field, const LookAt& picture) {
  Scene scene;
  scene.field = &field;
  scene.box = bounds(field);
  scene.spacing_m = std::min(field.dx_m, field.dy_m);
  scene.extent_m = std::max(field.cell_columns() * field.dx_m, field.cell_rows() * field.dy_m);
  scene.tan_half_fov_y = reproducible_tan(radians(picture.fov_y_deg) / 2.0);
  scene.tan_half_fov_x = scene.tan_half_fov_y * picture.width_px / picture.height_px;
  return scene;
}

}  // namespace

const std::vector<PresetHelp>& preset_help() {
  static const std::vector<PresetHelp> help = {
      {"oblique", "from above a border across the terrain, some sky"},
      {"top", "from straight above, north up, the whole terrain"},
      {"grazing", "low over the ground where the view is far"},
      {"valley", "from a low between high ground, along it"}};
  return help;
}

LookAt preset_camera(const Heightfield& field, const std::string& name, int width_px, int height_px,
                     double fov_y_deg) {
  require_valid(field);
  LookAt picture;
  picture.width_px = width_px;
  picture.height_px = height_px;
  picture.fov_y_deg = fov_y_deg;
  make_camera(picture);  // refuses a picture that cannot be
  std::string known;
  for (const PresetHelp& preset : preset_help()) {
    known += (known.empty() ? "" : ", ") + preset.name;
  }
  const bool is_known = std::any_of(preset_help().begin(), preset_help().end(),
                                    [&](const PresetHelp& preset) { return preset.name == name; });
  for (const PresetHelp& path : path_preset_help()) known += ", " + path.name;
  if (!is_known) input_error("camera preset '{}': expected {}", name, known);
  const Scene scene = scene_of(field, picture);
  const std::vector<Stand> stands = stands_of(field, name == "valley" ? 24 : 16);
  if (name == "top") return top(scene, stands, picture);
  if (stands.empty()) return look_at_a_sample(scene, picture);
  if (name == "grazing") return look(scene, grazing_view(scene, stands), picture);
  if (name == "valley") return look(scene, valley_view(scene, stands), picture);
  return look(scene, oblique_view(scene, stands), picture);
}

}  // namespace plumb::terrain
