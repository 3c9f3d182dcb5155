// Small terrains for tests: rough ones from integers alone, with voids where asked.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "terrain/generators.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

/// A number in [0, 1) that depends on its arguments alone.
inline double noise(std::uint32_t seed, int i, int j) {
  std::uint32_t x = seed * 0x9e3779b9u ^ static_cast<std::uint32_t>(i) * 0x85ebca6bu ^
                    static_cast<std::uint32_t>(j) * 0xc2b2ae35u;
  x = (x ^ (x >> 15)) * 0x2c1b3c6du;
  x = (x ^ (x >> 12)) * 0x297a2d39u;
  return static_cast<double>(x ^ (x >> 15)) / 4294967296.0;
}

/// Noise of several scales, interpolated: rough at every size, heights in about [0, relief].
inline double rough_height(std::uint32_t seed, int i, int j, double relief_m) {
  double height = 0.0, share = 0.5;
  for (int cell = 32; cell >= 1; cell /= 2, share *= 0.5) {
    const int a = i / cell, b = j / cell;
    const double u = static_cast<double>(i % cell) / cell, v = static_cast<double>(j % cell) / cell;
    const std::uint32_t s = seed + static_cast<std::uint32_t>(cell);
    height += share * ((1 - v) * ((1 - u) * noise(s, a, b) + u * noise(s, a + 1, b)) +
                       v * ((1 - u) * noise(s, a, b + 1) + u * noise(s, a + 1, b + 1)));
  }
  return height * relief_m;
}

inline terrain::Heightfield rough_terrain(int columns, int rows, std::uint32_t seed,
                                          double relief_m = 100.0, double void_share = 0.0,
                                          double dx_m = 10.0, double dy_m = 10.0) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(columns, rows);
  field.dx_m = dx_m;
  field.dy_m = dy_m;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      field.heights_m.floats()(i, j) = static_cast<float>(rough_height(seed, i, j, relief_m));
      // Voids come in clumps and alone.
      const bool is_void = noise(seed + 1000, i / 3, j / 3) < void_share ||
                           noise(seed + 2000, i, j) < void_share / 8;
      if (is_void) field.heights_m.floats()(i, j) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return field;
}

/// The heights of a generator: with `query`, which asks for the top surface of what makes stacks.
inline std::string heights_of(const terrain::GeneratorHelp& help, const std::string& query) {
  return "generate:" + help.name + "?" + query + (help.makes_stacks ? "&surface=top" : "");
}

}  // namespace plumb::test_support
