// The views that camera presets choose among. Not for users of the library.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

#include "core/box.h"
#include "terrain/sight.h"

namespace plumb::terrain {

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

inline glm::dvec3 forward_of(const View& view) { return {view.direction, view.pitch}; }

inline glm::dvec3 eye_over(const Stand& stand, double clearance_m) {
  return {stand.place_m.x, stand.place_m.y, stand.ground_m + clearance_m};
}

/// The pitch at which a skyline of this slope stands `part` of half the picture above its centre.
double pitch_under(double skyline, double part, const Scene& scene);

/// The best of some views from the border inwards, by a score of coarse pictures. At least one
/// stand.
View oblique_view(const Scene& scene, const std::vector<Stand>& stands);
/// The view along the ground that reaches farthest and shows most relief.
View grazing_view(const Scene& scene, std::vector<Stand> stands);
/// The view from the foot of a slope between high sides.
View valley_view(const Scene& scene, std::vector<Stand> stands);

}  // namespace plumb::terrain
