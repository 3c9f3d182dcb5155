// The cells of one level near a node: what they hold, and whose they are.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

#include "mesh/dual_contouring/allocation.h"
#include "mesh/dual_contouring/cell_loops.h"
#include "mesh/dual_contouring/lattice.h"
#include "mesh/dual_contouring/vertex_place.h"

namespace plumb::mesh::stacks {

using dual_contouring::Variant;

/// In whose node a sample lies, as its level sees it. What lies beyond the field is the level's
/// own.
enum class Owner : std::uint8_t { Own, Finer, Coarser };

/// Densities and owners of the samples of one level within a box.
///
/// A cell with a sample in a coarser node is none of this level: it is the cell that holds it one
/// level up.
class LevelCells {
 public:
  /// smoothed  densities of the level
  /// drawn     the same with those of the next level where they take their place
  /// owners    an empty lattice: all are the level's own
  /// All have one box.
  LevelCells(dual_contouring::Lattice<float> smoothed, dual_contouring::Lattice<float> drawn,
             dual_contouring::Lattice<Owner> owners);

  /// The lowest corners of the cells whose eight samples lie in the box.
  dual_contouring::LatticeBox cells() const { return masks_.box(); }
  dual_contouring::CellMask mask(const glm::ivec3& cell) const { return masks_(cell); }

  bool is_coarser(const glm::ivec3& cell) const;
  /// The vertices of a cell that is drawn on this level. `cell` lies one or more within cells().
  const dual_contouring::CellLoops& loops(const glm::ivec3& cell, Variant variant) const;
  /// What is drawn at a cell's corners, and the slopes of the level's own densities there.
  dual_contouring::CellCorners corners(const glm::ivec3& cell, bool with_gradients) const;
  /// Sobel's gradient of the level's own densities, per voxel; `at` within the cell.
  glm::dvec3 gradient(const glm::ivec3& cell, const glm::dvec3& at) const;

 private:
  bool is_drawn(const glm::ivec3& cell) const;

  dual_contouring::Lattice<float> smoothed_, drawn_;
  dual_contouring::Lattice<Owner> owners_;
  dual_contouring::Lattice<dual_contouring::CellMask> masks_;
};

}  // namespace plumb::mesh::stacks
