// Random terrains, views and options for tests of slices.
#pragma once

#include "slicing/slicing_cut.h"
#include "support/random_scene.h"
#include "support/test_terrain.h"

namespace plumb::test_support {

// Over the terrain, beside it, close to the ground.
inline Camera random_view(Random& random, const terrain::Heightfield& field) {
  const double width = field.cell_columns() * field.dx_m, depth = field.cell_rows() * field.dy_m;
  LookAt look;
  look.eye_m = {width * random.uniform(-0.6, 1.6), depth * random.uniform(-0.6, 1.6),
                random.uniform(20.0, 500.0)};
  look.target_m = {width * random.uniform(0.2, 0.8), depth * random.uniform(0.2, 0.8), 20.0};
  look.eye_m += field.world_origin_m();
  look.target_m += field.world_origin_m();
  look.fov_y_deg = random.uniform(5.0, 80.0);
  look.width_px = 48;
  look.height_px = 36;
  look.near_m = 1.0;
  return make_camera(look);
}

inline terrain::Heightfield random_ground(Random& random, std::uint32_t seed) {
  terrain::Heightfield field = rough_terrain(
      random.integer(20, 90), random.integer(20, 90), seed, random.uniform(5.0, 120.0),
      random.chance(0.3) ? 0.03 : 0.0, 10.0, random.chance(0.5) ? 10.0 : 6.0);
  if (random.chance(0.5)) field.origin_m = {4.5e5, 5.2e6};
  return field;
}

inline slicing::CutOptions random_cut_options(Random& random) {
  slicing::CutOptions options;
  options.variant =
      random.chance(0.5) ? slicing::Variant::Published : slicing::Variant::Conservative;
  options.tolerance_px = random.chance(0.5) ? 1.0 : random.uniform(0.5, 4.0);
  options.hybrid = random.chance(0.5);
  return options;
}

}  // namespace plumb::test_support
