// Faces between the vertices of the four cells round each crossing edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/dual_contouring/allocation.h"

namespace plumb::mesh::dual_contouring {

/// Vertices, counter-clockwise seen from outside; corners 0 and 2 lie in the cells p - a - b and p
/// of the edge from p along an axis, where (axis, a, b) are cyclic: between them runs the diagonal.
using Quad = std::array<std::uint32_t, 4>;

/// One face for each lattice edge whose ends differ and whose four cells are in the lattice, by p,
/// then axis x, y, z. A corner is the vertex whose loop holds that edge.
/// Source: [Löffler, Müller & Schumann 2011, section 3.2.5].
std::vector<Quad> quads_of(const ActiveCells& active);

}  // namespace plumb::mesh::dual_contouring
