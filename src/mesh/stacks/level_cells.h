// The cells of one level near a node: what they hold, and whose they are.
#pragma once

#include <glm/vec3.hpp>

#include <optional>

#include "mesh/dual_contouring/allocation.h"
#include "mesh/dual_contouring/cell_loops.h"
#include "mesh/dual_contouring/classification.h"
#include "mesh/dual_contouring/lattice.h"
#include "mesh/dual_contouring/vertex_place.h"
#include "mesh/stacks/node_places.h"

namespace plumb::mesh::stacks {

using dual_contouring::Variant;

/// In whose nodes the samples of a level lie, as that level sees it; the rest is of finer ones.
/// What lies beyond the field is the level's own.
struct Owners {
  NodePlaces places;
  PlaceBits own = 0, coarser = 0;
};

/// Densities and owners of the samples of one level within a box.
///
/// A cell with a sample in a coarser node is none of this level: it is the cell that holds it one
/// level up.
class LevelCells {
 public:
  /// smoothed  densities of the level
  /// drawn     the same with those of the next level where they take their place, of the same box;
  ///           none where they take no place
  LevelCells(dual_contouring::Lattice<float> smoothed,
             std::optional<dual_contouring::Lattice<float>> drawn, const Owners& owners);

  /// Which samples are inside, as they are drawn.
  const dual_contouring::InsideBits& inside() const { return inside_; }

  bool is_coarser(const glm::ivec3& cell) const {
    return owners_.coarser != 0 && (owners_.places.of(cell, cell + 1) & owners_.coarser) != 0;
  }
  /// The vertices of a cell that is drawn on this level. `cell` lies one or more within those whose
  /// samples lie in the box.
  const dual_contouring::CellLoops& loops(const glm::ivec3& cell, Variant variant) const;
  /// What is drawn at a cell's corners, and the slopes of the level's own densities there.
  dual_contouring::CellCorners corners(const glm::ivec3& cell, bool with_gradients) const;
  /// Sobel's gradient of the level's own densities, per voxel; `at` within the cell.
  glm::dvec3 gradient(const glm::ivec3& cell, const glm::dvec3& at) const;

 private:
  const dual_contouring::Lattice<float>& drawn() const { return drawn_ ? *drawn_ : smoothed_; }
  dual_contouring::CellMask mask(const glm::ivec3& cell) const {
    return inside_.mask(cell - inside_.samples().low);
  }
  bool is_drawn(const glm::ivec3& cell) const;

  dual_contouring::Lattice<float> smoothed_;
  std::optional<dual_contouring::Lattice<float>> drawn_;
  dual_contouring::InsideBits inside_;
  Owners owners_;
};

}  // namespace plumb::mesh::stacks
