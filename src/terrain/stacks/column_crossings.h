// Where vertical lines pass through a triangle mesh, decided exactly. Not for users of the library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace plumb::terrain {

/// Edges by how many triangles have them; those of no length are none.
struct EdgeCounts {
  std::int64_t boundary = 0;         // of one triangle
  std::int64_t non_manifold = 0;     // of more than two
  std::int64_t unbalanced = 0;       // that run more often one way than the other, boundary apart
  glm::dvec3 first_boundary_m{0.0};  // the middle of the first one, relative to the mesh's origin
};

EdgeCounts count_edges(const TriangleMesh& mesh);

/// The lines at (x_m[i], y_m[j]), relative to the mesh's origin; each rises.
struct LineGrid {
  std::vector<double> x_m, y_m;

  std::size_t size() const { return x_m.size() * y_m.size(); }
};

struct Crossing {
  double z_m = 0.0;
  int sign = 0;  // 1 upwards through a triangle that is counter-clockwise from above: out, -1 in
};

/// Crossings of line i + j * columns are [first[line], first[line + 1]), from the bottom up.
struct Crossings {
  std::vector<std::uint32_t> first;
  std::vector<Crossing> of;
};

/// Whether a line passes a triangle is decided in whole numbers, of vertices and lines on a lattice
/// of 2^-59 of the largest coordinate, and for a line moved east and, far less, north by less than
/// anything (simulation of simplicity).
///
///   (1) A line through an edge or a vertex passes one of the triangles that share it, seen from
///       either side of the sheet, and no vertical one: on every line the signs of a mesh whose
///       edges are balanced add up to zero.
/// Throws InputError for more than 2^32 - 1 crossings, or more than fit into memory.
/// Source: [Edelsbrunner & Mücke 1990].
Crossings cross(const TriangleMesh& mesh, const LineGrid& lines);

}  // namespace plumb::terrain
