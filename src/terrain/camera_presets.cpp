#include "terrain/camera_presets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "terrain/sight.h"

namespace plumb::terrain {
namespace {

constexpr int kDirections = 32;  // of the compass, counted from east towards north
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What every preset looks at.
struct Scene {
  const Heightfield* field = nullptr;
  Box box;  // of the heights, relative to the origin
  double spacing_m = 1.0;
  double extent_m = 0.0;  // the longer side
  double tan_half_fov_y = 0.0, tan_half_fov_x = 0.0;
};

/// A view relative to the terrain's origin.
struct View {
  glm::dvec3 eye_m{0.0};
  glm::dvec2 direction{1.0, 0.0};  // horizontal, unit
  double pitch = 0.0;              // tangent of the elevation angle
  double clearance_m = 1.0;        // of the eye above the ground
};

glm::dvec2 compass(int k) {
  const double angle = 2.0 * kPi * ((k % kDirections + kDirections) % kDirections) / kDirections;
  return {reproducible_cos(angle), reproducible_sin(angle)};
}

glm::dvec3 eye_over(const Stand& stand, double clearance_m) {
  return {stand.place_m.x, stand.place_m.y, stand.ground_m + clearance_m};
}

/// tan(a - b) from tan a and tan b.
double tangent_below(double tan_a, double tan_b) { return (tan_a - tan_b) / (1.0 + tan_a * tan_b); }

/// The pitch at which a skyline of this slope stands `part` of half the picture above its centre.
double pitch_under(double skyline, double part, const Scene& scene) {
  const double slope = std::isfinite(skyline) ? std::clamp(skyline, -2.0, 2.0) : 0.0;
  return tangent_below(slope, part * scene.tan_half_fov_y);
}

glm::dvec3 forward_of(const View& view) { return {view.direction, view.pitch}; }

LookAt look(const Scene& scene, const View& view, const LookAt& picture) {
  LookAt description = picture;
  const glm::dvec3 forward = forward_of(view);
  const auto hit = first_ground(*scene.field, scene.box, view.eye_m, forward);
  const double far_enough = std::max(scene.extent_m, scene.spacing_m);
  const double distance = hit && *hit > 0.0 ? *hit : far_enough;
  const glm::dvec3 origin = scene.field->world_origin_m();
  description.eye_m = origin + view.eye_m;
  description.target_m = origin + (view.eye_m + distance * forward);
  description.near_m = std::max(0.01, view.clearance_m / 10.0);
  return description;
}

// ---- oblique ----

/// How good a picture is, from a coarse grid of its rays: mostly ground, some sky, no ground
/// missing under the horizon, something in the middle.
double oblique_score(const Scene& scene, const View& view) {
  constexpr int kAcross = 16, kDown = 10;
  constexpr double kWantedGround = 0.72;
  const glm::dvec3 right{view.direction.y, -view.direction.x, 0.0};
  const glm::dvec3 forward = forward_of(view) / std::sqrt(1.0 + view.pitch * view.pitch);
  const glm::dvec3 up{right.y * forward.z, -right.x * forward.z,
                      right.x * forward.y - right.y * forward.x};
  int ground = 0, missing = 0, middle = 0;
  for (int row = 0; row < kDown; ++row) {
    for (int column = 0; column < kAcross; ++column) {
      const double x = ((column + 0.5) / kAcross * 2.0 - 1.0) * scene.tan_half_fov_x;
      const double y = (1.0 - (row + 0.5) / kDown * 2.0) * scene.tan_half_fov_y;
      const glm::dvec3 ray = forward + x * right + y * up;
      const bool hits = first_ground(*scene.field, scene.box, view.eye_m, ray).has_value();
      ground += hits ? 1 : 0;
      missing += !hits && ray.z < 0.0 ? 1 : 0;
      const bool central = row >= 4 && row < 6 && column >= 7 && column < 9;
      middle += hits && central ? 1 : 0;
    }
  }
  constexpr double kRays = kAcross * kDown;
  return 0.25 * middle - std::abs(ground / kRays - kWantedGround) - 1.5 * missing / kRays;
}

/// The stands nearest to the corners and to the middles of the borders of what is not void.
std::vector<Stand> border_stands(const std::vector<Stand>& stands) {
  glm::dvec2 low{kInfinity}, high{-kInfinity};
  for (const Stand& stand : stands) {
    low = {std::min(low.x, stand.place_m.x), std::min(low.y, stand.place_m.y)};
    high = {std::max(high.x, stand.place_m.x), std::max(high.y, stand.place_m.y)};
  }
  std::vector<Stand> chosen;
  for (int k = 0; k < 9; ++k) {
    if (k == 4) continue;  // the middle
    const glm::dvec2 wanted{low.x + (k % 3) * 0.5 * (high.x - low.x),
                            low.y + (k / 3) * 0.5 * (high.y - low.y)};
    const auto distance = [&](const Stand& s) {
      const glm::dvec2 d = s.place_m - wanted;
      return d.x * d.x + d.y * d.y;
    };
    chosen.push_back(*std::min_element(
        stands.begin(), stands.end(),
        [&](const Stand& a, const Stand& b) { return distance(a) < distance(b); }));
  }
  return chosen;
}

View oblique(const Scene& scene, const std::vector<Stand>& stands) {
  const double width = scene.box.high.x, length = scene.box.high.y;
  const double side = std::min(width, length);
  glm::dvec2 middle{0.0};
  for (const Stand& stand : stands) middle += stand.place_m / static_cast<double>(stands.size());
  std::vector<View> views;
  for (const Stand& stand : border_stands(stands)) {
    glm::dvec2 direction = middle - stand.place_m;
    const double distance = std::sqrt(direction.x * direction.x + direction.y * direction.y);
    direction = distance > 0.0 ? direction / distance : glm::dvec2(0.0, 1.0);
    for (const double rise : {0.06, 0.12, 0.2}) {
      const double clearance = std::max(rise * side, 0.5 * scene.spacing_m);
      for (const double part : {0.3, 0.5, 0.7}) {
        views.push_back({eye_over(stand, clearance), direction, part, clearance});
      }
    }
  }
  std::vector<double> scores(views.size());
  parallel_for(static_cast<std::int64_t>(views.size()), 1, [&](std::int64_t k) {
    View& view = views[static_cast<std::size_t>(k)];
    const SightLine line = look_along(*scene.field, view.eye_m, view.direction);
    view.pitch = pitch_under(line.skyline, view.pitch, scene);
    scores[static_cast<std::size_t>(k)] = oblique_score(scene, view);
  });
  return views[static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) -
                                        scores.begin())];
}

// ---- grazing and valley ----

/// What is seen from one eye all around.
using Panorama = std::array<SightLine, kDirections>;

Panorama panorama(const Heightfield& field, const glm::dvec3& eye_m) {
  Panorama lines;
  for (int k = 0; k < kDirections; ++k) {
    lines[static_cast<std::size_t>(k)] = look_along(field, eye_m, compass(k));
  }
  return lines;
}

const SightLine& at(const Panorama& lines, int k) {
  return lines[static_cast<std::size_t>((k % kDirections + kDirections) % kDirections)];
}

/// The best direction at the best stand; `score` rates a direction of a panorama.
template <class Score>
View best_standing_view(const Scene& scene, const std::vector<Stand>& stands, double clearance_m,
                        double part, const Score& score) {
  struct Found {
    double score = -kInfinity;
    int direction = 0;
    double skyline = 0.0;
  };
  std::vector<Found> found(stands.size());
  parallel_for(static_cast<std::int64_t>(stands.size()), 1, [&](std::int64_t index) {
    const auto s = static_cast<std::size_t>(index);
    const Panorama lines = panorama(*scene.field, eye_over(stands[s], clearance_m));
    for (int k = 0; k < kDirections; ++k) {
      const double rated = score(lines, k);
      if (rated > found[s].score) found[s] = {rated, k, at(lines, k).skyline};
    }
  });
  const auto best = std::max_element(
      found.begin(), found.end(), [](const Found& a, const Found& b) { return a.score < b.score; });
  const Stand& stand = stands[static_cast<std::size_t>(best - found.begin())];
  return {eye_over(stand, clearance_m), compass(best->direction),
          pitch_under(best->skyline, part, scene), clearance_m};
}

View grazing(const Scene& scene, const std::vector<Stand>& stands) {
  return best_standing_view(scene, stands, std::max(2.0, 0.1 * scene.spacing_m), 0.15,
                            [&](const Panorama& lines, int k) {
                              double sum = 0.0;  // the middle counts twice
                              for (const int side : {-2, -1, 0, 0, 1, 2}) {
                                sum += std::sqrt(at(lines, k + side).reach_m);
                              }
                              return at(lines, k).reach_m > 0.0 ? sum : -1.0;
                            });
}

/// Walks downhill in strides until nothing around is lower.
Stand downhill(const Scene& scene, Stand stand) {
  const double stride = std::max(scene.spacing_m, scene.extent_m / 400.0);
  for (int steps = 0; steps < 60; ++steps) {
    Stand lowest = stand;
    for (int k = 0; k < kDirections; k += 4) {
      const glm::dvec2 place = stand.place_m + stride * compass(k);
      const double ground = ground_height_m(*scene.field, place.x, place.y);
      if (ground < lowest.ground_m) lowest = {place, ground};  // false for NaN
    }
    if (lowest.ground_m == stand.ground_m) break;
    stand = lowest;
  }
  return stand;
}

View valley(const Scene& scene, std::vector<Stand> stands) {
  parallel_for(static_cast<std::int64_t>(stands.size()), 8, [&](std::int64_t k) {
    Stand& stand = stands[static_cast<std::size_t>(k)];
    stand = downhill(scene, stand);
  });
  const double clearance = std::max(2.0, 0.25 * scene.spacing_m);
  const auto walls = [](const Panorama& lines, int from, int to) {
    double highest = 0.0;
    for (int k = from; k <= to; ++k) highest = std::max(highest, at(lines, k).skyline);
    return std::min(highest, 1.0);  // steeper than 45 degrees is a wall before the nose
  };
  return best_standing_view(scene, stands, clearance, 0.25, [&](const Panorama& lines, int k) {
    const double sides = std::min(walls(lines, k - 7, k - 2), walls(lines, k + 2, k + 7));
    const double open = std::min(1.0, at(lines, k).reach_m / (0.25 * scene.extent_m));
    const double rises = std::clamp(at(lines, k).skyline, 0.0, 0.3);  // looks up the valley
    return at(lines, k).reach_m > 0.0 ? (0.02 + sides) * open * (0.5 + rises) : -1.0;
  });
}

// ---- top, and terrains without a cell ----

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
  const auto& heights = field.heights_m.values();
  const auto found =
      std::find_if(heights.begin(), heights.end(), [](float h) { return !std::isnan(h); });
  glm::dvec3 target{scene.extent_m / 2.0, scene.extent_m / 2.0, 0.0};
  if (found != heights.end()) {
    const std::int64_t index = found - heights.begin();
    target = {static_cast<double>(index % field.columns()) * field.dx_m,
              static_cast<double>(index / field.columns()) * field.dy_m, *found};
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
  if (!is_known) input_error("camera preset '{}': expected {}", name, known);
  const Scene scene = scene_of(field, picture);
  const std::vector<Stand> stands = stands_of(field, name == "valley" ? 24 : 16);
  if (name == "top") return top(scene, stands, picture);
  if (stands.empty()) return look_at_a_sample(scene, picture);
  if (name == "grazing") return look(scene, grazing(scene, stands), picture);
  if (name == "valley") return look(scene, valley(scene, stands), picture);
  return look(scene, oblique(scene, stands), picture);
}

}  // namespace plumb::terrain
