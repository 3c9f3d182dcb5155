#include "terrain/alpine.h"

#include <algorithm>
#include <cmath>

#include "terrain/gradient_noise.h"

namespace plumb::terrain {
namespace {

struct Alpine {
  double height_m, relief_m, feature_m, roughness, bend;
  int octaves;
  std::uint64_t seed;
};

/// Octaves whose wavelength is at least two spacings.
int octaves_down_to(double feature_m, double spacing_m) {
  int octaves = 1;
  for (double length = feature_m / 2.0; length >= 2.0 * spacing_m && octaves < 16; length /= 2.0) {
    ++octaves;
  }
  return octaves;
}

/// In [0, 1 / (1 - roughness)]; x and y in units of the largest feature.
double ridges(const Alpine& a, double x, double y) {
  constexpr double kGain = 2.0;  // how much of a ridge the next octave may roughen
  double sum = 0.0, amplitude = 1.0, weight = 1.0;
  for (int octave = 0; octave < a.octaves; ++octave) {
    const double ridge =
        1.0 - std::abs(gradient_noise(x, y, a.seed + static_cast<std::uint64_t>(octave)));
    const double signal = ridge * ridge * weight;
    sum += amplitude * signal;
    weight = std::min(1.0, kGain * signal);
    amplitude *= a.roughness;
    // Twice as fine, turned by the angle of the 3-4-5 triangle so that no lattice shows.
    const double turned = 1.6 * x - 1.2 * y;
    y = 1.2 * x + 1.6 * y + 0.37;
    x = turned + 0.71;
  }
  return sum;
}

double height_at(const Alpine& a, double x_m, double y_m) {
  const double x = x_m / a.feature_m, y = y_m / a.feature_m;
  const double east = gradient_noise(0.7 * x, 0.7 * y, a.seed ^ 0x5bd1e995u);
  const double north = gradient_noise(0.7 * x, 0.7 * y, a.seed ^ 0x1b873593u);
  const double massif = 0.5 + 0.5 * gradient_noise(0.31 * x, 0.31 * y, a.seed ^ 0xcc9e2d51u);
  const double shape = ridges(a, x + a.bend * east, y + a.bend * north);
  // Most of `shape` lies in 0.3 to 1.7; massifs stand out over the lower country between them.
  const double raised = (shape - 0.25) * (0.45 + 0.55 * massif);
  return a.height_m + a.relief_m * std::max(0.0, raised / 1.2);
}

}  // namespace

RowFiller alpine(const GeneratorValues& values, const GridShape& shape) {
  Alpine a{};
  a.height_m = values.number("height");
  a.relief_m = values.number("relief");
  a.feature_m = values.number("feature", 1e-3, 1e7);
  a.roughness = values.number("roughness", 0.0, 0.9);
  a.bend = values.number("bend", 0.0, 10.0);
  a.octaves = values.whole("octaves", 0, 16);
  if (a.octaves == 0) a.octaves = octaves_down_to(a.feature_m, std::min(shape.dx_m, shape.dy_m));
  a.seed = values.seed() * 0x9e3779b97f4a7c15ULL;
  return [a, shape](int j, std::span<float> row) {
    for (int i = 0; i < shape.columns; ++i) {
      row[static_cast<std::size_t>(i)] =
          static_cast<float>(height_at(a, i * shape.dx_m, j * shape.dy_m));
    }
  };
}

}  // namespace plumb::terrain
