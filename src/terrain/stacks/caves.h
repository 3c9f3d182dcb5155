// Mesas with arches, overhangs and caves, as stacks of rock, sandstone, limestone and soil.
#pragma once

#include "terrain/generated_voids.h"
#include "terrain/generator_parameters.h"
#include "terrain/stacks/stack_rows.h"

namespace plumb::terrain {

/// A density with the sign of the ground: solid where it is above zero. Of a place in the terrain,
/// with heights in parts of the relief and lengths in features,
///
///   ground   mesas between valleys: a two-dimensional noise pressed towards two levels
///   rough    octaves of three-dimensional noise, weaker where they add ground than where they take
///   strata   layers of hard and soft rock, the hard ones standing out
///   tunnel   where two three-dimensional noises are near zero together, which is along lines
///
///   solid(h) = ground + rough + strata > h, outside tunnels; always below a floor at a twentieth
///              of the relief, never above 0.985 of it
///
/// A stack is what the density's sign is at every quarter of a voxel from low_m up. Between two
/// samples of different sign, twelve halvings find a boundary: it lies within 2^-15 voxels of a
/// crossing, rounded to a float. What is thinner than a quarter of a voxel may be missed.
///
/// Materials: below an undulating level `rock`; above it `limestone` (hard) and `sandstone` (soft)
/// in turn; on what faces up, level enough and with room above, a layer of `soil`.
///
///   (1) low_m is `height`, high_m() the first whole voxel at or above `height` + `relief`; every
///       stack but a hole begins with rock and ends from 0.05 to 0.985 of the relief above it,
///       as far as floats tell heights apart.
///   (2) A smaller terrain is the south-west corner of a larger one.
/// Throws InputError for a value that does not fit, or for more than 65536 voxels up.
/// Source: our own, after the idea of [Geiss 2007].
class Caves {
 public:
  Caves(const GeneratorValues& values, const GridShape& shape);

  /// Sizes, spacing, heights and materials, without stacks.
  const StackField& shape() const { return shape_; }
  void fill_row(int j, const GeneratedVoids& voids, StackWriter& row) const;
  /// The sign of the density over stack (i, j), whatever voids there are.
  bool is_solid(int i, int j, double height_m) const;

 private:
  /// How thick soil lies on ground like that at (x, y), as a part of the relief.
  double soil_at(double x, double y, double ground) const;

  StackField shape_;
  double relief_m_ = 1.0, feature_m_ = 1.0, tunnels_ = 0.0, soil_m_ = 0.0;
  std::uint64_t seed_ = 0;
};

}  // namespace plumb::terrain
