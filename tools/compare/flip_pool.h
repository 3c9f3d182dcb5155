// One number, or a few, for a map of FLIP's errors.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace plumb::compare {

inline constexpr int kFlipBuckets = 100;

struct FlipPooled {
  std::int64_t pixels = 0;  // that counted
  double mean = 0.0;
  double least = 0.0, largest = 0.0;
  // Weighted percentiles: the least error e for which the pixels with errors up to e hold more than
  // a quarter, a half, three quarters of the sum of all errors.
  double first_quartile = 0.0, median = 0.0, third_quartile = 0.0;
  std::array<std::int64_t, kFlipBuckets> histogram{};  // pixels in [k / 100, (k + 1) / 100); the
                                                       // last one includes 1
};

/// errors    in [0, 1]
/// counted   empty (all count), or as many; a pixel counts where it is not 0
/// All numbers are 0 where no pixel counts.
/// Throws std::invalid_argument if lengths differ or an error lies outside [0, 1].
/// Source: [Andersson et al. 2020, section 5].
FlipPooled pool_flip(std::span<const float> errors, std::span<const std::uint8_t> counted = {});

/// The least error e for which the errors up to e sum to more than `share` of the sum of all
/// (the largest one where share is 1); 0 where there is no error at all. share in [0, 1].
double weighted_percentile(std::span<const float> errors, double share,
                           std::span<const std::uint8_t> counted = {});

}  // namespace plumb::compare
