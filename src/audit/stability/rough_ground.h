// Rough ground from integers alone: the same bits everywhere.
#pragma once

#include <cstdint>

namespace plumb::audit::stability {

/// A number in [0, 1) that depends on its arguments alone.
inline double noise(std::uint32_t seed, int i, int j) {
  std::uint32_t x = seed * 0x9e3779b9u ^ static_cast<std::uint32_t>(i) * 0x85ebca6bu ^
                    static_cast<std::uint32_t>(j) * 0xc2b2ae35u;
  x = (x ^ (x >> 15)) * 0x2c1b3c6du;
  x = (x ^ (x >> 12)) * 0x297a2d39u;
  return static_cast<double>(x ^ (x >> 15)) / 4294967296.0;
}

/// Noise of several scales, interpolated: rough at every size, heights in about [0, relief_m].
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

}  // namespace plumb::audit::stability
