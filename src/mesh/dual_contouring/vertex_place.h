// Where a cell's vertex lies, and which way its surface faces.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>

namespace plumb::mesh::dual_contouring {

enum class Placement {
  Mean,      // of the crossings: [Schmitz, Dietrich & Comba 2009], what the paper draws
  Qef,       // the quadric error function's minimum [Ju, Losasso, Schaefer & Warren 2002]
  Particle,  // a particle that the planes of the crossings pull [Schmitz et al. 2009]
};

const char* name_of(Placement placement);  // "mean", "qef", "particle"

/// The eight corners of a cell, by their bits x + 2 y + 4 z.
struct CellCorners {
  std::array<float, 8> density{};
  /// Of the density at each corner, per voxel; only Qef and Particle look at them.
  std::array<glm::dvec3, 8> gradient{};
};

/// The vertex of some crossing edges of a cell, in the cell's own coordinates: corner 0 is the
/// origin, corner 7 is (1, 1, 1).
///
/// edges    bit e for edge e (cell_loops.h); each one crosses, at least one does
/// returns  in [0, 1]^3
///
///   (1) A function of its arguments alone, with no libm: the same bits everywhere.
/// Crossing of an edge from density a to b: t = (1/2 - a) / (b - a).
glm::dvec3 place_vertex(const CellCorners& corners, std::uint16_t edges, Placement placement);

/// What is linear along all three axes between the corners, at a point of the cell.
double trilinear(const std::array<float, 8>& corners, const glm::dvec3& at);
glm::dvec3 trilinear(const std::array<glm::dvec3, 8>& corners, const glm::dvec3& at);

}  // namespace plumb::mesh::dual_contouring
