// Scenes in which every ray runs where rounding could decide.
#pragma once

#include <limits>

#include "support/random_scene.h"

namespace plumb::test_support {

/// Heights and spacings are small whole numbers here and so are the camera's, so that rays pass
/// exactly through samples, along grid lines and diagonals, within the planes of level cells, along
/// borders and past the corners of voids.
inline terrain::Heightfield whole_number_field(Random& random) {
  terrain::Heightfield field;
  const int columns = random.integer(2, 20), rows = random.integer(2, 20);
  field.heights_m = Grid<float>(columns, rows);
  field.dx_m = field.dy_m = 8.0;
  for (float& height : field.heights_m.floats().values()) {
    height = random.chance(0.1) ? std::numeric_limits<float>::quiet_NaN()
                                : static_cast<float>(8 * random.integer(0, 2));
  }
  return field;
}

inline Camera whole_number_camera(Random& random, const terrain::Heightfield& field,
                                  bool from_above) {
  Camera camera;
  camera.width_px = 65;
  camera.height_px = 49;
  camera.gamma_h = camera.gamma_v = 32.0;
  camera.centre_px = {32.5, 24.5};  // a pixel's centre, so that a ray runs straight ahead
  camera.near_m = 0.5;
  camera.eye_m = {8.0 * random.integer(0, field.cell_columns()), -8.0, 8.0 * random.integer(0, 3)};
  if (from_above) {
    camera.eye_m = {camera.eye_m.x, 8.0 * random.integer(0, field.cell_rows()), 256.0 + 16.0};
    camera.forward = {0.0, 0.0, -1.0};
    camera.up = {0.0, 1.0, 0.0};
  }
  return camera;
}

}  // namespace plumb::test_support
