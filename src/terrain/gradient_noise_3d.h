// Gradient noise in three dimensions, made for looking up and down at one place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "terrain/gradient_noise.h"

namespace plumb::terrain {

inline std::uint32_t lattice_hash(std::int64_t x, std::int64_t y, std::int64_t z,
                                  std::uint64_t seed) {
  return lattice_hash(x, y, seed + 0x165667b19e3779f9ULL * static_cast<std::uint64_t>(z));
}

/// What one horizontal plane of lattice points adds to the noise at the height w over its place
/// (x, y): at + rise * w.
struct NoisePlane {
  double at = 0.0, rise = 0.0;
};

/// The product of the offset (dx, dy, w) from a lattice point with the point's gradient, one of the
/// twelve from a cube's centre to the middles of its edges.
inline NoisePlane lattice_slope(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed,
                                double dx, double dy) {
  static constexpr double kX[12] = {1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0};
  static constexpr double kY[12] = {1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1};
  static constexpr double kZ[12] = {0, 0, 0, 0, 1, 1, -1, -1, 1, 1, -1, -1};
  const auto edge =
      static_cast<std::size_t>((std::uint64_t{lattice_hash(x, y, z, seed)} * 12) >> 32);
  return {kX[edge] * dx + kY[edge] * dy, kZ[edge]};
}

inline double noise_fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

/// A place among the lattice points: its cell, and its weights in it.
struct NoisePlace {
  NoisePlace(double x, double y)
      : i(floor_to_integer(x)),
        j(floor_to_integer(y)),
        u(x - static_cast<double>(i)),
        v(y - static_cast<double>(j)),
        s(noise_fade(u)),
        t(noise_fade(v)) {}

  std::int64_t i, j;
  double u, v, s, t;
};

inline NoisePlane noise_plane(const NoisePlace& p, std::int64_t z, std::uint64_t seed) {
  const auto mixed = [](const NoisePlane& a, const NoisePlane& b, double part) {
    return NoisePlane{a.at + part * (b.at - a.at), a.rise + part * (b.rise - a.rise)};
  };
  const NoisePlane south = mixed(lattice_slope(p.i, p.j, z, seed, p.u, p.v),
                                 lattice_slope(p.i + 1, p.j, z, seed, p.u - 1.0, p.v), p.s);
  const NoisePlane north =
      mixed(lattice_slope(p.i, p.j + 1, z, seed, p.u, p.v - 1.0),
            lattice_slope(p.i + 1, p.j + 1, z, seed, p.u - 1.0, p.v - 1.0), p.s);
  return mixed(south, north, p.t);
}

inline constexpr double kNoiseToOne = 1.0 / 1.0364;  // 1.03636 is reached near (0.36, 0.48, 0.5)

/// Between two planes, w in [0, 1] above the lower one.
inline double noise_between(const NoisePlane& lower, const NoisePlane& upper, double w) {
  const double below = lower.at + lower.rise * w, above = upper.at + upper.rise * (w - 1.0);
  return kNoiseToOne * (below + noise_fade(w) * (above - below));
}

/// Gradient noise at (x, y, z), all below 2^52: twice continuously differentiable, 0 at every
/// lattice point, within [-1, 1].
/// Source: [Perlin 2002], with a hash in place of the permutation table.
inline double gradient_noise(double x, double y, double z, std::uint64_t seed) {
  const NoisePlace place(x, y);
  const std::int64_t k = floor_to_integer(z);
  return noise_between(noise_plane(place, k, seed), noise_plane(place, k + 1, seed),
                       z - static_cast<double>(k));
}

/// The noise above one place: planes are made once, heights are cheap.
///
///   (1) at(z) is gradient_noise(x, y, z, seed) to the bit.
///   (2) It changes by at most steepest() per unit of z between low and high.
class NoiseColumn {
 public:
  /// Looks from z = low to z = high, low <= high.
  void stand_at(double x, double y, double low, double high, std::uint64_t seed) {
    const NoisePlace place(x, y);
    lowest_ = floor_to_integer(low);
    const std::int64_t highest = floor_to_integer(high) + 1;
    planes_.resize(static_cast<std::size_t>(highest - lowest_ + 1));
    for (std::int64_t k = lowest_; k <= highest; ++k)
      planes_[static_cast<std::size_t>(k - lowest_)] = noise_plane(place, k, seed);
    steepest_ = 0.0;
    for (std::size_t k = 1; k < planes_.size(); ++k)
      steepest_ = std::max(steepest_, steepest_between(planes_[k - 1], planes_[k]));
  }

  double steepest() const { return steepest_; }

  double at(double z) const {
    const std::int64_t k = floor_to_integer(z);
    const NoisePlane* plane = planes_.data() + (k - lowest_);
    return noise_between(plane[0], plane[1], z - static_cast<double>(k));
  }

 private:
  // The slope of noise_between() is a mean of both rises, and the difference of the two planes'
  // lines, which is the largest at an end, times the slope of the fade, at most 15/8.
  static double steepest_between(const NoisePlane& lower, const NoisePlane& upper) {
    const double apart = upper.at - lower.at;
    return kNoiseToOne *
           (std::max(std::abs(lower.rise), std::abs(upper.rise)) +
            1.875 * std::max(std::abs(apart - upper.rise), std::abs(apart - lower.rise)));
  }

  std::int64_t lowest_ = 0;
  std::vector<NoisePlane> planes_;
  double steepest_ = 0.0;
};

}  // namespace plumb::terrain
