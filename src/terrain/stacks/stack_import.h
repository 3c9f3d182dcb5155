// What importers of stacks share. Not for users of the library.
#pragma once

#include <string>

#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// A material with a colour of its own: of the names that terrain has, or by its number.
MaterialInfo material_named(const std::string& name, std::size_t number);

/// The number of a material of this name, which is added if there is none; "air" is kAir. Throws
/// InputError for an empty name, or beyond 256 materials.
Material add_material(StackField& field, const std::string& name);

/// Sets low_m, voxel_m and voxels: low_m one voxel or more below `low_m`, on a multiple of
/// voxel_m, the top above `high_m`; voxel_m 0 is the mean of dx and dy. Throws InputError for more
/// than 2^31 - 1 voxels, or heights that single precision does not tell from the next voxel.
void reach(StackField& field, double low_m, double high_m, double voxel_m);

}  // namespace plumb::terrain
