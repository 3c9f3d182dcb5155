// Small random terrains and cameras, the same on every machine.
#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "core/box.h"
#include "core/camera.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

/// Uniform numbers made from the generator's own bits, since std:: distributions differ.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  int integer(int low, int high) {  // both included
    return low + static_cast<int>(bits_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::mt19937_64 bits_;
};

enum class Relief { Noise, Terraces, Walls, Spikes, Flat, Count };

/// 2 to 33 samples a side, cells that need not be square, any origin, voids in one of two terrains.
inline terrain::Heightfield random_heightfield(Random& random) {
  terrain::Heightfield field;
  const int columns = random.integer(2, 33), rows = random.integer(2, 33);
  field.heights_m = Grid<float>(columns, rows);
  field.dx_m = random.chance(0.5) ? 10.0 : random.uniform(0.3, 60.0);
  field.dy_m = random.chance(0.5) ? field.dx_m : random.uniform(0.3, 60.0);
  if (random.chance(0.5)) {
    field.origin_m = {5e5 + random.uniform(0.0, 1e3), 4.5e6 + random.uniform(0.0, 1e3)};
  }
  const auto relief = static_cast<Relief>(random.integer(0, static_cast<int>(Relief::Count) - 1));
  const double tilt_x = random.uniform(-0.3, 0.3), tilt_y = random.uniform(-0.3, 0.3);
  const double amplitude = random.uniform(0.0, 3.0) * field.dx_m;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      double z = 0.0;
      switch (relief) {
        case Relief::Noise:
          z = tilt_x * i * field.dx_m + tilt_y * j * field.dy_m +
              random.uniform(-amplitude, amplitude);
          break;
        case Relief::Terraces:
          z = 5.0 * random.integer(0, 2);
          break;
        case Relief::Walls:
          z = (i / 5 + j / 7) % 2 ? 100.0 * field.dx_m : 0.0;
          break;
        case Relief::Spikes:
          z = random.chance(0.03) ? random.uniform(1.0, 50.0) * field.dx_m : tilt_x * i;
          break;
        case Relief::Flat:
        case Relief::Count:
          z = 12.0;
          break;
      }
      field.heights_m.floats()(i, j) = static_cast<float>(z);
    }
  }
  if (random.chance(0.5)) {
    const double share = random.chance(0.3) ? 0.5 : 0.05;
    for (float& height : field.heights_m.floats().values()) {
      if (random.chance(share)) height = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return field;
}

enum class View { Top, Oblique, Grazing, Below, Inside, Count };

/// A camera that looks at a point of the terrain's box in one of several ways.
inline Camera random_camera(Random& random, const terrain::Heightfield& field, View view,
                            int width_px, int height_px) {
  Box box = bounds(field);
  if (box.empty()) box = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  const glm::dvec3 size = box.high - box.low;
  const double reach = std::max({size.x, size.y, size.z});
  const auto within = [&](double low, double high) {
    return glm::dvec3{box.low.x + size.x * random.uniform(low, high),
                      box.low.y + size.y * random.uniform(low, high),
                      box.low.z + size.z * random.uniform(low, high)};
  };
  LookAt look;
  look.target_m = within(0.2, 0.8);
  look.eye_m = look.target_m;
  const double away = reach * random.uniform(0.3, 2.0);
  switch (view) {
    case View::Top:
      look.eye_m.z = box.high.z + away;
      break;
    case View::Below:
      look.eye_m = within(-0.5, 1.5);
      look.eye_m.z = box.low.z - away;
      break;
    case View::Oblique:
      look.eye_m += glm::dvec3{random.uniform(-1.0, 1.0) * away, -away, 0.7 * away};
      break;
    case View::Grazing:
      look.eye_m = {box.low.x + size.x * random.uniform(0.0, 1.0), box.low.y - 0.1 * size.y,
                    box.low.z + size.z * random.uniform(0.5, 1.2)};
      look.target_m.z = look.eye_m.z - 0.02 * reach * random.uniform(0.0, 1.0);
      break;
    case View::Inside:
    case View::Count:
      look.eye_m = within(0.1, 0.9);
      break;
  }
  if (look.eye_m == look.target_m) look.target_m.y += 1.0;
  look.eye_m += field.world_origin_m();
  look.target_m += field.world_origin_m();
  look.fov_y_deg = random.uniform(20.0, 90.0);
  look.width_px = width_px;
  look.height_px = height_px;
  look.near_m = random.chance(0.8) ? 0.01 : 0.2 * reach;
  if (random.chance(0.1)) look.far_m = look.near_m + reach;
  return make_camera(look);
}

}  // namespace plumb::test_support
