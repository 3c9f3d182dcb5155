// The vertex stage on many vertices at once.
#pragma once

#include <cstdint>

#include "core/instruction_set.h"
#include "raster/fixed_point.h"

namespace plumb::raster {

/// A projection's numbers, and what marks a vertex that must be clipped.
struct WindowTransform {
  double origin[3];  // of the mesh, relative to the eye
  double right[3], up[3], forward[3];
  double gamma_h, gamma_v, centre_x, centre_y, near;
  double guard_left, guard_right, guard_top, guard_bottom;  // what view depth counts for there
  double farthest;
  std::int32_t clipped;  // x of a vertex that some plane cuts off; its y is the planes' bits
};

/// Takes `count` vertices (x, y, z each) to the window, with the bits that Projection's functions
/// give. Returns false if one is not finite or farther than `farthest`.
using TransformVertices = bool (*)(const WindowTransform&, const double* vertices,
                                   std::int64_t count, ScreenVertex* window);

TransformVertices transform_vertices(InstructionSet set);

}  // namespace plumb::raster
