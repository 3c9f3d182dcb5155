// Which crossing edges of a cell of the lattice belong to one vertex.
#pragma once

#include <array>
#include <cstdint>

namespace plumb::mesh::dual_contouring {

/// Corner bits of a cell: bit x + 2 y + 4 z is set where the sample at that corner is inside.
using CellMask = std::uint8_t;

/// Edge of a cell: 4 * axis + k, where k holds the place of the edge along the two other axes in
/// cyclic order: axis x: y + 2 z; axis y: z + 2 x; axis z: x + 2 y.
constexpr int kCellEdges = 12;

/// The corner at the lower end of an edge; the upper one is 1 << axis more.
constexpr int lower_corner(int edge) {
  const int axis = edge / 4, k = edge % 4;
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  return (k & 1) << second | (k >> 1) << third;
}

/// The edge along `axis` whose lower end is `corner`.
constexpr int edge_at(int corner, int axis) {
  return 4 * axis + (corner >> (axis + 1) % 3 & 1) + 2 * (corner >> (axis + 2) % 3 & 1);
}

/// The crossing edges of a cell, by the vertices that they belong to.
struct CellLoops {
  int count = 0;  // vertices: 0 to 4, in the order of their lowest edges
  std::array<std::int8_t, kCellEdges> of_edge{};  // of each edge; -1 where it does not cross
  std::array<std::uint16_t, 4> edges{};           // of each vertex, bit e for edge e
};

/// One vertex for all crossing edges: [Löffler, Müller & Schumann 2011, section 3.2], after
/// [Schmitz, Dietrich & Comba 2009].
const CellLoops& single_loop(CellMask mask);

/// One vertex for each loop: on each face of the cell a curve cuts off every run of inside corners
/// (two diagonal ones: two curves), and the curves join the crossing edges. Where `split`, the two
/// curves on face_to_split(mask) cut off its outside corners instead.
/// Source: dual marching cubes [Nielson 2004]; [Schaefer, Ju & Warren 2007].
const CellLoops& manifold_loops(CellMask mask, bool split = false);

/// The face, 2 * axis + side, on which two curves belong to one loop; -1 where there is none. 36
/// masks have one. Where two such cells share that face, both are to be split, or edges with four
/// faces remain.
int face_to_split(CellMask mask);

}  // namespace plumb::mesh::dual_contouring
