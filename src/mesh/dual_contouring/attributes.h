// What the vertices are given: places, normals, materials.
#pragma once

#include <glm/vec3.hpp>

#include <span>
#include <vector>

#include "mesh/dual_contouring/allocation.h"
#include "mesh/dual_contouring/faces.h"
#include "mesh/dual_contouring/gradients.h"
#include "mesh/dual_contouring/lattice.h"
#include "mesh/dual_contouring/vertex_place.h"

namespace plumb::mesh::dual_contouring {

/// The densities at a cell's corners, and their central gradients where `with_gradients`; the cell
/// is one of cells_of(density.box()).
CellCorners corners_of(const Lattice<float>& density, const glm::ivec3& cell, bool with_gradients);

/// The place of each vertex in units of the lattice: its cell's lower corner and what place_vertex
/// says.
std::vector<glm::dvec3> vertex_positions(const Lattice<float>& density, const ActiveCells& active,
                                         Placement placement);

/// Unit normals, outwards: Sobel's gradient at the cell's eight samples, trilinear at the vertex,
/// negated. Where that is zero, the sum of the area normals of the faces round the vertex, in their
/// order, each from its two diagonals; where that is zero too, zero.
std::vector<glm::dvec3> vertex_normals(const Lattice<float>& density, const ActiveCells& active,
                                       std::span<const glm::dvec3> positions,
                                       std::span<const Quad> quads);

/// Of each vertex the part of each material: their densities, trilinear at the vertex, over their
/// sum.
///
/// materials  densities of all materials but air, lattices of one box that holds the active cells'
///            samples
/// returns    vertices x materials; of a vertex round which no material is, all are zero
std::vector<float> vertex_materials(std::span<const Lattice<float>> materials,
                                    const ActiveCells& active,
                                    std::span<const glm::dvec3> positions);

}  // namespace plumb::mesh::dual_contouring
