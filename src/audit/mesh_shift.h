// How far a mesh stands beside its place. Not for users of the library.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

#include "audit/truth.h"

namespace plumb::audit {

struct MeshShift {
  glm::dvec3 by_m{0.0};  // that brings the points nearest to the terrain below and above them
  double off_m = 0.0;    // mean of |z - h| then, over the points that stand over it
};

/// By damped steps of Gauss and Newton from where the points are (relative to the terrain's
/// origin); large distances count by their size, not its square. A way to go that leaves a tenth of
/// the points beside the terrain is none. Of a shift longer than the terrain's features it may find
/// another, which explains little.
MeshShift shift_to_terrain(const HeightfieldTruth& truth, const std::vector<glm::dvec3>& points);

}  // namespace plumb::audit
