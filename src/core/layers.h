// What stands before a pixel's hit and lets some of it through.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace plumb {

/// Ground that is seen with a weight in [0, 1].
struct Layer {
  glm::dvec3 from_eye_m{0.0};  // its point, relative to the eye
  float weight = 0.0f;
};

/// The layers of a picture. A pixel's colour is that of each of its layers' ground by its weight,
/// of its hit (of the sky where nothing is hit) by `behind`, and of the fog by what is then left of
/// one.
struct Layers {
  std::vector<std::uint64_t> first;  // pixel k has layers [first[k], first[k + 1]), front to back
  std::vector<Layer> layers;
  std::vector<float> behind;  // a pixel each
  glm::dvec3 fog{0.0};        // linear colour

  /// Nothing is blended: every pixel shows its hit or the sky.
  bool empty() const { return first.empty(); }
};

}  // namespace plumb
