// How far the vertices of one mesh lie from another.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

#include "audit/distribution.h"
#include "core/triangle_mesh.h"

namespace plumb::audit {

/// The largest of both ways bounds the Hausdorff distance from below.
struct VertexDistances {
  std::vector<float> metres;  // of each vertex that a triangle uses, in their order; +inf: the
                              // other mesh has no triangle
  Distribution distribution;  // of these
  glm::dvec3 worst_m{0.0};    // the vertex that is farthest off, relative to the terrain's origin
  std::uint32_t worst_vertex = 0;               // its index
  std::uint32_t worst_triangle = kNoPrimitive;  // of the drawn mesh: the vertex's, or the nearest
};

}  // namespace plumb::audit
