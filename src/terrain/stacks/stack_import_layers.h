// Stacks from surfaces that lie over each other: bedrock and soil, a bridge between DTM and DSM.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// What lies below a surface, down to the surface before.
struct MaterialSurface {
  std::string material;  // "air" is a gap: what is under a bridge or a roof
  Heightfield top;
};

struct LayeredStacks {
  StackField field;
  std::int64_t holes = 0;               // stacks where a surface is void
  std::vector<std::int64_t> pinched;    // of each surface: where it lies at or below those before
  std::vector<double> deepest_pinch_m;  // and how far below at most
};

/// Stacks from surfaces on one grid, from the bottom up: the first material reaches from low_m to
/// the first surface, the next from there to its own.
///
/// voxel_m  as stacks_of has it
///
///   (1) Where a surface lies at or below one before it, its layer has no thickness there, which is
///       counted, and said in the field's provenance.
///   (2) A void of any surface is a hole.
/// Throws InputError for no surface, one without a height, a topmost one of air, and for surfaces
/// of different size, spacing, place or coordinate system: the line says which, and by what. Places
/// and spacings are the same if no corner is off by more than a millionth of a cell.
LayeredStacks stacks_of_layers(std::span<const MaterialSurface> surfaces, double voxel_m = 0.0);

}  // namespace plumb::terrain
