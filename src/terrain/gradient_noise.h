// Smooth noise from a hash of whole numbers: no table, no state, the same bits everywhere.
#pragma once

#include <cstdint>

namespace plumb::terrain {

/// 32 well mixed bits of a lattice point and a seed.
inline std::uint32_t lattice_hash(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t h = seed + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(x) +
                    0xc2b2ae3d27d4eb4fULL * static_cast<std::uint64_t>(y);
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ULL;
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ULL;
  return static_cast<std::uint32_t>(h ^ (h >> 32));
}

/// The same as a number in [0, 1).
inline double lattice_part(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  return lattice_hash(x, y, seed) * 0x1p-32;
}

/// Product of the offset (dx, dy) from a lattice point with the point's unit gradient, one of
/// sixteen directions 22.5 degrees apart.
inline double lattice_slope(std::int64_t x, std::int64_t y, std::uint64_t seed, double dx,
                            double dy) {
  static constexpr double k1 = 0.92387953251128674, k2 = 0.70710678118654752,
                          k3 = 0.38268343236508977;
  static constexpr double kX[16] = {1.0,  k1,  k2,  k3,  0.0, -k3, -k2, -k1,
                                    -1.0, -k1, -k2, -k3, 0.0, k3,  k2,  k1};
  static constexpr double kY[16] = {0.0, k3,  k2,  k1,  1.0,  k1,  k2,  k3,
                                    0.0, -k3, -k2, -k1, -1.0, -k1, -k2, -k3};
  const std::uint32_t direction = lattice_hash(x, y, seed) >> 28;
  return kX[direction] * dx + kY[direction] * dy;
}

/// The largest whole number that is not above x, |x| < 2^52 (without the library's call).
inline std::int64_t floor_to_integer(double x) {
  const auto towards_zero = static_cast<std::int64_t>(x);
  return towards_zero - (static_cast<double>(towards_zero) > x ? 1 : 0);
}

/// Gradient noise at (x, y), |x| and |y| below 2^52: twice continuously differentiable, 0 at every
/// lattice point, within [-1, 1].
/// Source: [Perlin 2002], with a hash in place of the permutation table.
inline double gradient_noise(double x, double y, std::uint64_t seed) {
  const std::int64_t i = floor_to_integer(x), j = floor_to_integer(y);
  const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const double s = fade(u), t = fade(v);
  const double south_west = lattice_slope(i, j, seed, u, v);
  const double south_east = lattice_slope(i + 1, j, seed, u - 1.0, v);
  const double north_west = lattice_slope(i, j + 1, seed, u, v - 1.0);
  const double north_east = lattice_slope(i + 1, j + 1, seed, u - 1.0, v - 1.0);
  const double south = south_west + s * (south_east - south_west);
  const double north = north_west + s * (north_east - north_west);
  constexpr double kToOne = 1.4142135623730951;  // the extreme lies at a cell's centre, sqrt(1/2)
  return kToOne * (south + t * (north - south));
}

}  // namespace plumb::terrain
