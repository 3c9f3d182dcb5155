#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "terrain/preset_views.h"

namespace plumb::terrain {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// tan(a - b) from tan a and tan b.
double tangent_below(double tan_a, double tan_b) { return (tan_a - tan_b) / (1.0 + tan_a * tan_b); }

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

}  // namespace

double pitch_under(double skyline, double part, const Scene& scene) {
  const double slope = std::isfinite(skyline) ? std::clamp(skyline, -2.0, 2.0) : 0.0;
  return tangent_below(slope, part * scene.tan_half_fov_y);
}

View oblique_view(const Scene& scene, const std::vector<Stand>& stands) {
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

}  // namespace plumb::terrain
