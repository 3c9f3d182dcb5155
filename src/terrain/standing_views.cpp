#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "terrain/preset_views.h"

namespace plumb::terrain {
namespace {

constexpr int kDirections = 32;  // of the compass, counted from east towards north
constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec2 compass(int k) {
  const double angle = 2.0 * kPi * ((k % kDirections + kDirections) % kDirections) / kDirections;
  return {reproducible_cos(angle), reproducible_sin(angle)};
}

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

/// Walks downhill in strides until nothing around is lower.
Stand downhill(const Scene& scene, Stand stand) {
  const double stride = std::max(scene.spacing_m, scene.extent_m / 400.0);
  for (int steps = 0; steps < 60; ++steps) {
    Stand lowest = stand;
    for (int k = 0; k < kDirections; k += 4) {
      const glm::dvec2 place = stand.place_m + stride * compass(k);
      const double ground = ground_height_m(*scene.field, place.x, place.y);
      if (ground < lowest.ground_m) lowest = {place, ground, false};  // false for NaN
    }
    if (lowest.ground_m == stand.ground_m) break;
    stand = lowest;
  }
  return stand;
}

}  // namespace

View grazing_view(const Scene& scene, std::vector<Stand> stands) {
  // Nobody stands on water, where there is land.
  const auto land = std::stable_partition(stands.begin(), stands.end(),
                                          [](const Stand& stand) { return !stand.is_level; });
  if (land != stands.begin()) stands.erase(land, stands.end());
  const double much_relief = 0.25 * (scene.box.high.z - scene.box.low.z);
  const auto worth = [&](const SightLine& line) {
    const double relief = much_relief > 0.0 ? std::min(1.0, line.relief_m / much_relief) : 0.0;
    return std::sqrt(line.reach_m) * (0.25 + relief) * (4 + std::min(line.layers, 8));
  };
  return best_standing_view(scene, stands, std::max(2.0, 0.1 * scene.spacing_m), 0.15,
                            [&](const Panorama& lines, int k) {
                              if (at(lines, k).reach_m <= 0.0) return -1.0;
                              double sum = 0.0;  // the middle counts twice
                              for (const int side : {-2, -1, 0, 0, 1, 2}) {
                                sum += worth(at(lines, k + side));
                              }
                              return sum;
                            });
}

View valley_view(const Scene& scene, std::vector<Stand> stands) {
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
    // Along the valley and up it: the end rises, but less than the sides.
    const double end = std::clamp(at(lines, k).skyline, 0.0, 0.3);
    const double depth = 0.02 + std::max(0.0, sides - 0.7 * end);
    return at(lines, k).reach_m > 0.0 ? depth * open * (1.0 + 2.0 * end) : -1.0;
  });
}

}  // namespace plumb::terrain
