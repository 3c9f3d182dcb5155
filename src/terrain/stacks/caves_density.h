// Where the ground of the terrain `caves` is solid: the density of terrain/stacks/caves.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/gradient_noise_3d.h"

namespace plumb::terrain {

inline constexpr double kCaveStrata = 6.0;  // pairs of a soft and a hard layer in the relief

/// What does not change with the height over one place, heights as parts of the relief.
struct CavePlace {
  double x = 0.0, y = 0.0;  // in features, bent
  double ground = 0.0;      // the height of the mesas and valleys
  double wildness = 0.0;    // the largest waves of the roughness
  double stands_out = 0.0;  // how far hard strata stand out
  double dip = 0.0;         // how far the strata are lifted, in pairs
  double tunnel = 0.0;      // both noises of a tunnel are nearer to zero; below zero: no tunnels
  double bedrock = 0.0;     // below it are no strata
  double top = 0.0;         // no ground is higher
};

/// x and y in features; `tunnels` widens the tunnels.
CavePlace place_among_caves(double x, double y, double tunnels, std::uint64_t seed);

/// CavePlace::ground alone.
double cave_ground_at(double x, double y, std::uint64_t seed);

/// The ground above one place, h being parts of the relief above the bottom.
class CaveColumn {
 public:
  void stand_at(const CavePlace& place, std::uint64_t seed);

  bool is_solid(double h) const { return look(h).is_solid; }

  /// Where the ground ends and begins in turn, from h = 0 up, where it is solid.
  ///
  /// step  between samples: an end is where two neighbours differ, halved twelve times
  ///
  ///   (1) The same as if every sample were looked at: those that are passed over have the sign of
  ///       the one below them, as the density changes by no more than `steepest_` per height.
  void find_ends(double step, std::vector<double>& ends) const;

 private:
  struct Sight {
    bool is_solid;
    double safe;  // how far up that stays so, at least
  };
  Sight look(double h) const;
  double ground_density(double h) const;
  double tunnel_density(double h) const;
  double end_between(double low, double high, bool low_is_solid) const;

  CavePlace place_;
  std::array<NoiseColumn, 4> rough_;
  std::array<NoiseColumn, 2> tunnel_;
  double steepest_ = 1.0, steepest_tunnel_ = 1.0;
};

}  // namespace plumb::terrain
