#include "compare/flip_pool.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "core/check.h"

namespace plumb::compare {
namespace {

// Bits of floats from 0 to 1 ascend with their values: their upper half names one of these.
constexpr std::size_t kRanges = (0x3f800000u >> 16) + 1;

std::size_t range_of(float error) { return std::bit_cast<std::uint32_t>(error) >> 16; }

// What counts, its sum by ranges of value, so that no percentile needs all of it sorted.
struct Weighed {
  std::vector<float> errors;
  std::vector<double> sums = std::vector<double>(kRanges, 0.0);
  double sum = 0.0;
};

Weighed weigh(std::span<const float> errors, std::span<const std::uint8_t> counted) {
  require(counted.empty() || counted.size() == errors.size(),
          "there must be as many marks as errors ({}), or none, got {}", errors.size(),
          counted.size());
  Weighed weighed;
  weighed.errors.reserve(errors.size());
  for (std::size_t k = 0; k < errors.size(); ++k) {
    if (!counted.empty() && counted[k] == 0) continue;
    require(errors[k] >= 0.0f && errors[k] <= 1.0f, "errors must be in [0, 1], got {}", errors[k]);
    const float error = errors[k] + 0.0f;  // no negative zero
    weighed.errors.push_back(error);
    weighed.sums[range_of(error)] += error;
  }
  for (const double sum : weighed.sums) weighed.sum += sum;
  return weighed;
}

double percentile_of(const Weighed& weighed, double share) {
  const double target = share * weighed.sum;
  double below = 0.0;
  std::size_t chosen = 0;
  for (std::size_t range = 0; range < kRanges; ++range) {
    if (weighed.sums[range] == 0.0) continue;
    if (chosen != 0) below += weighed.sums[chosen];
    chosen = range;
    if (below + weighed.sums[range] > target) break;
  }
  std::vector<float> within;
  for (const float error : weighed.errors) {
    if (range_of(error) == chosen) within.push_back(error);
  }
  std::sort(within.begin(), within.end());
  for (const float error : within) {
    below += error;
    if (below > target) return error;
  }
  return within.empty() ? 0.0 : within.back();
}

}  // namespace

double weighted_percentile(std::span<const float> errors, double share,
                           std::span<const std::uint8_t> counted) {
  require(share >= 0.0 && share <= 1.0, "share must be in [0, 1], got {}", share);
  return percentile_of(weigh(errors, counted), share);
}

FlipPooled pool_flip(std::span<const float> errors, std::span<const std::uint8_t> counted) {
  const Weighed weighed = weigh(errors, counted);
  FlipPooled pooled;
  pooled.pixels = static_cast<std::int64_t>(weighed.errors.size());
  if (weighed.errors.empty()) return pooled;
  const auto [least, largest] = std::minmax_element(weighed.errors.begin(), weighed.errors.end());
  pooled.least = *least;
  pooled.largest = *largest;
  pooled.mean = weighed.sum / static_cast<double>(pooled.pixels);
  pooled.first_quartile = percentile_of(weighed, 0.25);
  pooled.median = percentile_of(weighed, 0.5);
  pooled.third_quartile = percentile_of(weighed, 0.75);
  for (const float error : weighed.errors) {
    const int bucket = static_cast<int>(std::floor(static_cast<double>(error) * kFlipBuckets));
    ++pooled.histogram[static_cast<std::size_t>(std::min(bucket, kFlipBuckets - 1))];
  }
  return pooled;
}

}  // namespace plumb::compare
