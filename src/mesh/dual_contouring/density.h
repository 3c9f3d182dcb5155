// How much of each voxel is not air.
#pragma once

#include "mesh/dual_contouring/lattice.h"
#include "mesh/dual_contouring/nearest_stack.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::mesh::dual_contouring {

/// The part of each voxel that layers other than air cover.
///
/// level    the stacks; holes take the nearest stack that is none
/// box      samples: (i, j, k) is voxel k of stack (i, j), from low_m + k * voxel_m up. The box may
///          reach beyond the field: sideways the border's stack goes on, below the lowest layer,
///          above is air
/// returns  in [0, 1]; whole voxels are 0 and 1 to the bit
///
///   (1) A sample is a function of its stack and its k alone, not of the box.
///   (2) Layers that touch count as one: the border between two materials changes no bit.
/// Throws std::invalid_argument for a field without stacks or of holes alone.
/// Source: [Löffler, Müller & Schumann 2011, section 3.2.1].
Lattice<float> density_of(const terrain::StackField& level, const LatticeBox& box);

/// The same with the stand-ins for holes worked out before: for many boxes of one field.
Lattice<float> density_of(const terrain::StackField& level, const LatticeBox& box,
                          const NearestStacks& nearest);

/// The part of each voxel that one material covers, which is not air.
Lattice<float> material_density_of(const terrain::StackField& level, terrain::Material material,
                                   const LatticeBox& box);
Lattice<float> material_density_of(const terrain::StackField& level, terrain::Material material,
                                   const LatticeBox& box, const NearestStacks& nearest);

}  // namespace plumb::mesh::dual_contouring
