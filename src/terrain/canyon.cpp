#include "terrain/canyon.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "terrain/gradient_noise.h"

namespace plumb::terrain {
namespace {

constexpr double kCliffWidth = 0.05;  // part of a layer's width that its cliff takes
constexpr double kFloor = 0.06;       // half the river's floor
constexpr double kWall = 0.44;        // from there to the rim

/// One layer of rock; widths and rises are parts of the whole wall, counted from its foot.
struct Layer {
  double foot_at, width;
  double foot, rise;
  double cliff;  // part of the rise
};

// Lengths below are in widths of the gorge.
struct Canyon {
  double height_m, relief_m, width_m, bend, middle;
  std::uint64_t seed;
  std::vector<Layer> layers;
};

std::vector<Layer> layers_of(int count, std::uint64_t seed) {
  std::vector<Layer> layers(static_cast<std::size_t>(count));
  double width = 0.0, rise = 0.0;
  for (int k = 0; k < count; ++k) {
    Layer& layer = layers[static_cast<std::size_t>(k)];
    layer.foot_at = width;
    layer.foot = rise;
    width += layer.width = 0.6 + 0.8 * lattice_part(k, 1, seed);
    rise += layer.rise = 0.5 + lattice_part(k, 2, seed);
    layer.cliff = 0.45 + 0.45 * lattice_part(k, 3, seed);
  }
  for (Layer& layer : layers) {
    layer.foot_at /= width;
    layer.width /= width;
    layer.foot /= rise;
    layer.rise /= rise;
  }
  return layers;
}

/// Height in [0, 1] of a place in [0, 1] on the way from the wall's foot to its rim.
double terraced(const std::vector<Layer>& layers, double way) {
  if (way <= 0.0) return 0.0;
  if (way >= 1.0) return 1.0;
  std::size_t k = layers.size() - 1;
  while (k > 0 && way < layers[k].foot_at) --k;
  const Layer& layer = layers[k];
  const double part = std::min(1.0, (way - layer.foot_at) / layer.width);
  constexpr double kSlope = 1.0 - kCliffWidth;
  const double on_slope = std::min(1.0, part / kSlope);
  const double on_cliff = std::max(0.0, part - kSlope) / kCliffWidth;
  return layer.foot + layer.rise * ((1.0 - layer.cliff) * on_slope + layer.cliff * on_cliff);
}

/// Channels that leave another about every `every`, on one side of it.
struct Branches {
  double every, wall, length;
  std::uint64_t seed;
};

struct Branch {
  double beside;  // signed distance from its channel
  double climb;   // how far up the walls its channel lies there
};

/// The branch of number `cell`, seen from a point `along` the channel that it leaves and `away`
/// from it.
Branch branch_at(const Branches& b, std::int64_t cell, double along, double away) {
  const double mouth =
      (static_cast<double>(cell) + 0.2 + 0.6 * lattice_part(cell, 1, b.seed)) * b.every;
  const double length = b.length * (0.5 + lattice_part(cell, 2, b.seed));
  return {along - mouth, std::max(0.0, away) / length};
}

/// How far up the walls a point lies for the nearest tributaries and their own branches.
double tributaries_at(double along, double away, std::uint64_t seed) {
  const Branches stems{1.15, 0.55 * kWall, 2.6, seed};
  const std::int64_t cell = floor_to_integer(along / stems.every);
  double lowest = 1.0;
  for (std::int64_t n = cell - 1; n <= cell + 1; ++n) {
    const Branch stem = branch_at(stems, n, along, away - kFloor);
    if (stem.climb >= 1.0) continue;
    const double side = std::abs(stem.beside);
    lowest = std::min(lowest, stem.climb + std::max(0.0, side - 0.02) / stems.wall);
    const Branches gullies{0.38, 0.3 * kWall, 0.75,
                           seed + 2 * static_cast<std::uint64_t>(n) + (stem.beside > 0.0 ? 1 : 0)};
    const double up =
        away + 0.15 * gradient_noise(4.0 * side, 1.3 * static_cast<double>(n) + 0.4, seed);
    const std::int64_t gully_cell = floor_to_integer(up / gullies.every);
    for (std::int64_t m = gully_cell - 1; m <= gully_cell + 1; ++m) {
      const Branch gully = branch_at(gullies, m, up, side);
      lowest = std::min(lowest, stem.climb + gully.climb + std::abs(gully.beside) / gullies.wall);
    }
  }
  return lowest;
}

double height_at(const Canyon& c, double x, double y) {
  // Spurs and alcoves: the coordinates bent at a fifth of the gorge's width, and finer.
  const double bent_x = x + 0.05 * gradient_noise(5.0 * x, 5.0 * y, c.seed ^ 0x1b873593u) +
                        0.016 * gradient_noise(17.0 * x, 17.0 * y, c.seed ^ 0x2545f491u);
  const double bent_y = y + 0.05 * gradient_noise(5.0 * x, 5.0 * y, c.seed ^ 0xcc9e2d51u) +
                        0.016 * gradient_noise(17.0 * x, 17.0 * y, c.seed ^ 0x6c62272eu);
  const double meander = gradient_noise(0.62 * bent_x, 0.2 * bent_y, c.seed) +
                         0.3 * gradient_noise(1.7 * bent_x, 0.5 * bent_y, c.seed + 1);
  const double across = bent_y - c.middle + c.bend * meander;
  const double away = std::abs(across);
  const std::uint64_t side = c.seed ^ (across > 0.0 ? 0x9e3779b9u : 0x85ebca6bu);
  const double along = bent_x + 0.35 * gradient_noise(0.9 * bent_x, 1.1 * away, side);
  const double way = std::min((away - kFloor) / kWall, tributaries_at(along, away, side + 1));
  return c.height_m + c.relief_m * terraced(c.layers, way);
}

}  // namespace

RowFiller canyon(const GeneratorValues& values, const GridShape& shape) {
  Canyon c{};
  c.height_m = values.number("height");
  c.relief_m = values.number("relief", 0.0, 1e7);
  c.width_m = values.number("width", 1.0, 1e7);
  c.bend = values.number("bend", 0.0, 4.0);
  c.middle = (shape.rows - 1) * shape.dy_m / 2.0 / c.width_m;
  c.seed = values.seed() * 0x9e3779b97f4a7c15ULL;
  c.layers = layers_of(values.whole("strata", 1, 100), c.seed);
  return [c, shape](int j, std::span<float> row) {
    const double y = j * shape.dy_m / c.width_m;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double x = static_cast<double>(i) * shape.dx_m / c.width_m;
      row[i] = static_cast<float>(height_at(c, x, y));
    }
  };
}

}  // namespace plumb::terrain
