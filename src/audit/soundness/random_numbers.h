// Random numbers of one case, whatever other cases draw.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/reproducible_math.h"

namespace plumb::audit::soundness {

/// The sequence of one (seed, index): the same bits on every machine, other ones for every index.
/// Source: splitmix64, the generator of java.util.SplittableRandom.
class RandomNumbers {
 public:
  RandomNumbers(std::uint64_t seed, std::uint64_t index)
      : state_(mixed(seed + kStep) ^ mixed(index * 0xd1342543de82ef95ULL + 1)) {}

  std::uint64_t bits() { return mixed(state_ += kStep); }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }
  /// Its logarithm is uniform.
  double log_uniform(double low, double high) {
    return reproducible_exp(uniform(reproducible_log(low), reproducible_log(high)));
  }
  int integer(int low, int high) {  // both included
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  template <class Item>
  const Item& one_of(const std::vector<Item>& items) {
    return items[static_cast<std::size_t>(bits() % items.size())];
  }
  /// An index, each as often as its weight says.
  std::size_t weighted(const std::vector<double>& weights) {
    double sum = 0.0;
    for (const double weight : weights) sum += weight;
    double at = uniform(0.0, sum);
    for (std::size_t k = 0; k + 1 < weights.size(); ++k) {
      if (at < weights[k]) return k;
      at -= weights[k];
    }
    return weights.size() - 1;
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;
  static constexpr std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace plumb::audit::soundness
