#include "terrain/stacks/caves_density.h"

#include <algorithm>
#include <cmath>

namespace plumb::terrain {
namespace {

// Heights are parts of the relief, lengths are features.
constexpr double kFloor = 0.05, kCeiling = 0.985;
constexpr double kStandsOut = 0.04;  // of hard strata on flanks; soft ones step back as far
constexpr double kFiner = 2.03, kGain = 0.48;         // of each octave against the one before
constexpr double kRoughAcross = 2.6, kRoughUp = 2.4;  // its largest waves, per feature and relief
constexpr double kTunnelAcross = 2.4, kTunnelUp = 1.5;
constexpr double kCalmest = 0.03, kWildest = 0.30;
constexpr double kLifts = 0.35;  // of the roughness, where it adds ground

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

struct Ground {
  double x, y, height;
  double flank;  // 0 where it is level to 1 between the levels
};

Ground ground_at(double x, double y, std::uint64_t seed) {
  Ground g{};
  g.x = x + 0.22 * gradient_noise(1.3 * x, 1.3 * y, seed ^ 0x5bd1e995u);
  g.y = y + 0.22 * gradient_noise(1.3 * x, 1.3 * y, seed ^ 0x1b873593u);
  const double broad = gradient_noise(g.x, g.y, seed + 1);
  const double middle = gradient_noise(2.3 * g.x + 0.3, 2.3 * g.y + 0.6, seed + 2);
  const double fine = gradient_noise(6.1 * g.x + 0.7, 6.1 * g.y + 0.2, seed + 3);
  const double mesa = smooth_step(0.5 + 2.2 * (broad + 0.7 * middle + 0.12 * fine));
  g.flank = 4.0 * mesa * (1.0 - mesa);
  g.height = 0.16 + 0.54 * mesa + 0.10 * broad + 0.06 * middle + 0.02 * fine;
  return g;
}

double strata_wave(double turns) {
  const double p = turns - static_cast<double>(floor_to_integer(turns));
  return 32.0 * p * p * (1.0 - p) * (1.0 - p) - 1.0;
}
constexpr double kSteepestWave = 6.16;  // per turn: 64 p (1 - p) (1 - 2 p) at most

}  // namespace

CavePlace place_among_caves(double x, double y, double tunnels, std::uint64_t seed) {
  const Ground ground = ground_at(x, y, seed);
  CavePlace place;
  place.x = ground.x;
  place.y = ground.y;
  place.ground = ground.height;
  place.stands_out = kStandsOut * (0.2 + 0.8 * ground.flank);
  const double wild = gradient_noise(1.1 * x + 0.4, 1.1 * y + 0.1, seed + 4);
  place.wildness = std::clamp((0.13 + 0.2 * wild) * (0.6 + 0.6 * ground.flank), kCalmest, kWildest);
  const double wide = gradient_noise(1.4 * x + 0.9, 1.4 * y + 0.6, seed + 5);
  place.tunnel = tunnels > 0.0 ? tunnels * std::max(0.0, 0.16 + 0.14 * wide) : -1.0;
  place.dip = 0.4 * x + 0.25 * y + 1.2 * gradient_noise(0.6 * x, 0.6 * y, seed + 6);
  place.bedrock = 0.17 + 0.09 * gradient_noise(0.9 * x + 0.2, 0.9 * y, seed + 7);
  place.top = std::clamp(ground.height + 2.0 * kLifts * place.wildness + place.stands_out, kFloor,
                         kCeiling);
  return place;
}

double cave_ground_at(double x, double y, std::uint64_t seed) {
  return ground_at(x, y, seed).height;
}

void CaveColumn::stand_at(const CavePlace& place, std::uint64_t seed) {
  place_ = place;
  double across = kRoughAcross, up = kRoughUp, amplitude = place.wildness;
  steepest_ = 1.0 + kSteepestWave * kCaveStrata * place.stands_out;
  for (std::size_t k = 0; k < rough_.size(); ++k) {
    rough_[k].stand_at(across * place.x + 0.19, across * place.y + 0.53, 0.0, up * place.top,
                       seed + 10 + k);
    steepest_ += amplitude * up * rough_[k].steepest();
    across *= kFiner;
    up *= kFiner;
    amplitude *= kGain;
  }
  for (std::size_t k = 0; k < tunnel_.size(); ++k)
    tunnel_[k].stand_at(kTunnelAcross * place.x + 0.41, kTunnelAcross * place.y + 0.23, 0.0,
                        kTunnelUp * place.top, seed + 20 + k);
  const double a = tunnel_[0].steepest(), b = tunnel_[1].steepest();
  steepest_tunnel_ = kTunnelUp * std::sqrt(a * a + b * b);
}

double CaveColumn::ground_density(double h) const {
  double sum = 0.0, amplitude = 1.0, up = kRoughUp;
  for (const NoiseColumn& octave : rough_) {
    sum += amplitude * octave.at(up * h);
    amplitude *= kGain;
    up *= kFiner;
  }
  const double rough = place_.wildness * (sum > 0.0 ? kLifts * sum : sum);
  const double strata = place_.stands_out * strata_wave(kCaveStrata * h + place_.dip);
  return std::min(place_.ground + rough + strata, kCeiling) - h;
}

double CaveColumn::tunnel_density(double h) const {
  const double a = tunnel_[0].at(kTunnelUp * h), b = tunnel_[1].at(kTunnelUp * h);
  return std::sqrt(a * a + b * b) - place_.tunnel;
}

CaveColumn::Sight CaveColumn::look(double h) const {
  if (h < kFloor) return {true, kFloor - h};
  if (h > place_.top) return {false, 1.0};
  const double ground = ground_density(h), tunnel = tunnel_density(h);
  const double of_ground = std::abs(ground) / steepest_;
  const double of_tunnel = std::abs(tunnel) / steepest_tunnel_;
  if (ground > 0.0 && tunnel > 0.0) return {true, std::min(of_ground, of_tunnel)};
  const double of_air = std::max(ground > 0.0 ? 0.0 : of_ground, tunnel > 0.0 ? 0.0 : of_tunnel);
  return {false, std::min(of_air, 1.0)};
}

double CaveColumn::end_between(double low, double high, bool low_is_solid) const {
  constexpr int kHalvings = 12;
  for (int n = 0; n < kHalvings; ++n) {
    const double middle = 0.5 * (low + high);
    (is_solid(middle) == low_is_solid ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void CaveColumn::find_ends(double step, std::vector<double>& ends) const {
  constexpr double kSure = 0.999;  // of what is safe, to be above all rounding
  ends.clear();
  Sight last = look(0.0);
  for (std::int64_t k = 0; last.is_solid || static_cast<double>(k) * step <= place_.top;) {
    const double below = static_cast<double>(k) * step;
    // Samples within what is safe have the sign of this one.
    k += std::max<std::int64_t>(1, static_cast<std::int64_t>(kSure * last.safe / step));
    const double here = static_cast<double>(k) * step;
    const Sight sight = look(here);
    if (sight.is_solid != last.is_solid) ends.push_back(end_between(below, here, last.is_solid));
    last = sight;
  }
}

}  // namespace plumb::terrain
