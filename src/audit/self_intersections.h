// Triangles of a mesh that pass through each other.
#pragma once

#include <cstdint>

#include "core/triangle_mesh.h"

namespace plumb::audit {

/// Pairs of triangles that have no corner in one place and an edge of one of which passes through
/// the inside of the other. The triangles' boxes are sorted into a grid, so that every pair whose
/// boxes meet is looked at, once.
///
///   (1) Decided in plain double: pairs that only touch, or lie in one plane, are none; of those
///       that pass by each other within rounding some may be counted and some left out.
///   (2) The same number on every number of threads.
/// Time grows with the pairs that share a cell, a few for each triangle of a surface.
std::int64_t self_intersections_of(const TriangleMesh& mesh);

}  // namespace plumb::audit
