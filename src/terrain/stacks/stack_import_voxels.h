// Stacks from a grid of voxels.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

struct VoxelGridShape {
  int columns = 0, rows = 0, voxels = 0;  // east, north, up; each >= 1
  double dx_m = 1.0, dy_m = 1.0, voxel_m = 1.0;
  glm::dvec2 origin_m{0.0};            // of the south-western column of voxels
  float low_m = 0.0F;                  // where the lowest voxel begins
  std::vector<std::string> materials;  // of index 1, 2, ...; "material1", ... where there are none
};

/// Runs of equal voxels as layers: voxel v reaches from low_m + v * voxel_m to low_m + (v + 1) *
/// voxel_m, rounded to float.
///
/// indices  of materials, x fastest, then y, then z, from the south-western voxel at the bottom; 0
///          is air
/// Throws InputError if there are not as many indices as voxels, for a shape that is none, and for
/// voxels so low that single precision does not tell their ends apart.
StackField stacks_of_voxels(std::span<const std::uint8_t> indices, const VoxelGridShape& shape);

/// The same of a bare file of such bytes. Throws InputError with its name, also if it cannot be
/// read or held.
StackField read_voxels(const std::string& path, const VoxelGridShape& shape);

}  // namespace plumb::terrain
