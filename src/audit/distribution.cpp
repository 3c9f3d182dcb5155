#include "audit/distribution.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

// Pieces of at least so many values, and at most about sixteen of them: each has a histogram.
std::int64_t grain_of(std::size_t size) {
  return std::max<std::int64_t>(1 << 16, static_cast<std::int64_t>(size) / 8);
}

// Triangles are numbered by 32 bits, so nothing that is counted here is more than they hold.
using Histogram = std::vector<std::uint32_t>;

// Bits of floats >= 0 (and +inf) order as the floats do.
std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value);
}

// Classes of values by their upper bits, without the sign, and those of one class by the others.
constexpr std::size_t kUpperClasses = 1 << 15, kLowerClasses = 1 << 16;

Histogram sum_of(Histogram a, const Histogram& b) {
  if (a.empty()) return b;
  for (std::size_t k = 0; k < b.size(); ++k) a[k] += b[k];
  return a;
}

struct Sums {
  std::int64_t count = 0;
  double max_finite = 0.0, squares = 0.0;
  Histogram upper;
};

Sums sums_of(std::span<const float> values) {
  return parallel_ordered_reduce(
      static_cast<std::int64_t>(values.size()), grain_of(values.size()), Sums{},
      [&](std::int64_t begin, std::int64_t end, Sums s) {
        s.upper.resize(kUpperClasses);
        for (std::int64_t k = begin; k < end; ++k) {
          const float value = values[static_cast<std::size_t>(k)];
          if (std::isnan(value)) continue;
          ++s.count;
          ++s.upper[bits(value) >> 16];
          const double finite = std::isinf(value) ? 0.0 : value;
          s.max_finite = std::max(s.max_finite, finite);
          s.squares += finite * finite;
        }
        return s;
      },
      [](Sums a, const Sums& b) {
        return Sums{a.count + b.count, std::max(a.max_finite, b.max_finite), a.squares + b.squares,
                    sum_of(std::move(a.upper), b.upper)};
      });
}

constexpr std::size_t kRanks = 4;
using Ranks = std::array<std::int64_t, kRanks>;

// The values of the given ranks (from 0), found by their upper and then their lower sixteen bits,
// all of them in one pass.
std::array<double, kRanks> values_of_ranks(std::span<const float> values, const Histogram& upper,
                                           Ranks ranks) {
  std::array<std::uint32_t, kRanks> high{};
  for (std::size_t r = 0; r < kRanks; ++r) {
    for (; upper[high[r]] <= ranks[r]; ++high[r]) ranks[r] -= upper[high[r]];
  }
  // Ranks of one class share a histogram: the last of them has it.
  const auto histogram_of = [&](std::uint32_t upper_bits) {
    std::size_t at = kRanks;
    for (std::size_t r = 0; r < kRanks; ++r) at = high[r] == upper_bits ? r : at;
    return at;
  };
  const Histogram lower = parallel_ordered_reduce(
      static_cast<std::int64_t>(values.size()), grain_of(values.size()), Histogram{},
      [&](std::int64_t begin, std::int64_t end, Histogram counts) {
        counts.resize(kRanks * kLowerClasses);
        for (std::int64_t k = begin; k < end; ++k) {
          const std::uint32_t value = bits(values[static_cast<std::size_t>(k)]);
          const std::size_t at = histogram_of(value >> 16);
          if (at < kRanks) ++counts[at * kLowerClasses + (value & 0xffffu)];
        }
        return counts;
      },
      sum_of);
  std::array<double, kRanks> found{};
  for (std::size_t r = 0; r < kRanks; ++r) {
    std::uint32_t low = 0;
    const std::uint32_t* counts = lower.data() + histogram_of(high[r]) * kLowerClasses;
    for (; counts[low] <= ranks[r]; ++low) ranks[r] -= counts[low];
    found[r] = std::bit_cast<float>((high[r] << 16) | low);
  }
  return found;
}

}  // namespace

Distribution distribution_of(std::span<const float> values) {
  const Sums sums = sums_of(values);
  Distribution d;
  d.count = sums.count;
  if (d.count == 0) return d;
  d.infinite = sums.upper[bits(std::numeric_limits<float>::infinity()) >> 16];
  d.max_finite = sums.max_finite;
  d.max = d.infinite > 0 ? std::numeric_limits<double>::infinity() : d.max_finite;
  if (d.count > d.infinite)
    d.rms = std::sqrt(sums.squares / static_cast<double>(d.count - d.infinite));
  // Nearest rank: the smallest value that at least `share` of all values do not exceed; share as
  // thousandths, exactly.
  const auto rank = [&](std::int64_t thousandths) {
    return (d.count * thousandths + 999) / 1000 - 1;
  };
  const std::array<double, kRanks> found =
      values_of_ranks(values, sums.upper, {rank(500), rank(950), rank(990), rank(999)});
  d.p50 = found[0];
  d.p95 = found[1];
  d.p99 = found[2];
  d.p999 = found[3];
  return d;
}

}  // namespace plumb::audit
