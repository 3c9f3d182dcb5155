// The smoothed densities of every level of a field of stacks.
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

#include "core/box.h"
#include "mesh/dual_contouring/density.h"
#include "mesh/dual_contouring/lattice.h"
#include "mesh/dual_contouring/smoothing.h"
#include "mesh/stacks/octree.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::mesh::stacks {

/// The levels of detail of a field, and what a node sees of them. Lattice steps are those of the
/// finest level: stack (i, j) stands at (i + 1/2, j + 1/2), height low_m is 0.
class StackDensities {
 public:
  /// Throws std::invalid_argument if the field or the filter is not valid, InputError if it has
  /// holes alone.
  StackDensities(terrain::StackField finest, const dual_contouring::Filter& filter);

  const terrain::StackField& field() const { return levels_.front(); }
  const dual_contouring::Filter& filter() const { return filter_; }
  /// Columns, rows and voxels of the finest level.
  glm::ivec3 size() const;
  std::size_t bytes() const;
  bool has_holes() const { return !field().holes.empty(); }
  /// Of a stack of a level.
  bool is_hole(int level, int i, int j) const {
    return levels_[static_cast<std::size_t>(level)].is_hole(i, j);
  }

  /// A DensitySource: what density_of() and smoothed() say, faster where there is no surface.
  dual_contouring::Lattice<float> operator()(int level,
                                             const dual_contouring::LatticeBox& box) const;
  /// What all samples of a box are, where that is plain from the stacks: 1 ground, 0 air.
  std::optional<float> uniform(int level, const dual_contouring::LatticeBox& box) const;
  dual_contouring::Lattice<float> of_material(int level, terrain::Material material,
                                              const dual_contouring::LatticeBox& box) const;
  /// The materials but air whose density may be above zero somewhere in a box: all others are zero
  /// there.
  std::vector<terrain::Material> materials_in(int level,
                                              const dual_contouring::LatticeBox& box) const;

  /// A place on the lattice in metres, relative to (field().origin_m, 0).
  glm::dvec3 metres(const glm::dvec3& steps) const;
  /// A gradient per voxel as one per metre, of any length.
  glm::dvec3 gradient_in_metres(const glm::dvec3& per_voxel) const;
  /// A node's voxels, in metres as above.
  Box box(const Node& node) const;

 private:
  std::vector<terrain::StackField> levels_;
  std::vector<dual_contouring::NearestStacks> nearest_;
  dual_contouring::Filter filter_;
};

}  // namespace plumb::mesh::stacks
