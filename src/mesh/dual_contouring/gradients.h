// The slope of the density at samples.
#pragma once

#include <glm/vec3.hpp>

#include <array>

#include "mesh/dual_contouring/lattice.h"

namespace plumb::mesh::dual_contouring {

/// The density's slope at a sample, per voxel, by differences of its two neighbours along each
/// axis; where one lies beyond the lattice, by the one that is there. Sharper than Sobel's: what
/// Placement::Qef and Placement::Particle look at.
glm::dvec3 central_gradient(const Lattice<float>& density, const glm::ivec3& sample);

/// The same by the 3D Sobel operator, (-1 0 1) by (1 2 1) by (1 2 1) over 32, with the lattice's
/// border repeated beyond it: what normals come from.
glm::dvec3 sobel_gradient(const Lattice<float>& density, const glm::ivec3& sample);

/// Of the eight corners of a cell, by their bits: the bits of the functions above, faster.
std::array<glm::dvec3, 8> central_gradients(const Lattice<float>& density, const glm::ivec3& cell);
std::array<glm::dvec3, 8> sobel_gradients(const Lattice<float>& density, const glm::ivec3& cell);

}  // namespace plumb::mesh::dual_contouring
