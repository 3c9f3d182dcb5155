// What can be seen of a terrain from a place, roughly: enough to choose a view, never to judge one.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

#include "terrain/heightfield.h"

namespace plumb::terrain {

// Coordinates here are relative to the terrain's origin, metres.

/// The height of the ground at a place, the higher one of the two ways in which its cell may be cut
/// into triangles; NaN outside the terrain and in cells with a void sample.
double ground_height_m(const Heightfield& field, double x_m, double y_m);

/// A place to stand: inside a cell whose four samples exist.
struct Stand {
  glm::dvec2 place_m{0.0};
  double ground_m = 0.0;
  bool is_level = false;  // its cell's four samples are equally high: water, or a floor
};

/// The stand nearest to the middle of each of up to `per_side` x `per_side` equal blocks of cells,
/// in the order of rows from the south; blocks of nothing but voids have none.
std::vector<Stand> stands_of(const Heightfield& field, int per_side);

/// What is seen looking from `eye_m` along one compass direction (unit vector).
struct SightLine {
  double reach_m = 0.0;   // horizontal distance of the farthest ground that is seen; 0: none
  double skyline = 0.0;   // tangent of the highest ground's elevation angle; -inf: no ground
  double relief_m = 0.0;  // between the lowest and the highest ground that is seen
  int layers = 0;         // stretches of ground that is seen, with hidden ground between them
};
SightLine look_along(const Heightfield& field, const glm::dvec3& eye_m,
                     const glm::dvec2& direction);

/// Parameter t > 0 at which eye + t * direction first lies under the ground, found by steps of half
/// a spacing near the eye and of a hundredth of the distance far away.
std::optional<double> first_ground(const Heightfield& field, const Box& box,
                                   const glm::dvec3& eye_m, const glm::dvec3& direction);

}  // namespace plumb::terrain
