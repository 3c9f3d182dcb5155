#include "audit/distribution.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
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

// Bits of floats >= 0 (and +inf) order as the floats do, without the sign that zero may have; NaN
// comes after them.
std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value) & 0x7fffffffu; }

// Classes of values by their upper bits, and those of one class by the others.
constexpr std::size_t kUpperClasses = 1 << 15, kLowerClasses = 1 << 16;
std::uint32_t class_of(float value) { return bits(value) >> 16; }

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

// Maximum and squares side by side, so that one value need not wait for the one before.
class FiniteSums {
 public:
  void add(std::span<const float> values) {
    std::size_t k = 0;
    for (; k + kLanes <= values.size(); k += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) add(values[k + lane], lane);
    }
    for (; k < values.size(); ++k) add(values[k], k % kLanes);
  }
  double max() const { return *std::max_element(max_, max_ + kLanes); }
  double squares() const { return std::accumulate(squares_, squares_ + kLanes, 0.0); }

 private:
  static constexpr std::size_t kLanes = 8;
  void add(float value, std::size_t lane) {
    // NaN is no value, and +inf is counted alone.
    const double finite = value <= std::numeric_limits<float>::max() ? value : 0.0;
    max_[lane] = finite > max_[lane] ? finite : max_[lane];
    squares_[lane] += finite * finite;
  }
  double max_[kLanes] = {}, squares_[kLanes] = {};
};

// Neighbours mostly are of one class: they count in turns, so that one need not wait for another.
Histogram upper_histogram(std::span<const float> values) {
  constexpr std::size_t kTurns = 4;
  Histogram counts(kTurns * kUpperClasses);
  std::size_t k = 0;
  for (; k + kTurns <= values.size(); k += kTurns) {
    for (std::size_t turn = 0; turn < kTurns; ++turn)
      ++counts[turn * kUpperClasses + class_of(values[k + turn])];
  }
  for (; k < values.size(); ++k) ++counts[class_of(values[k])];
  for (std::size_t at = 0; at < kUpperClasses; ++at) {
    for (std::size_t turn = 1; turn < kTurns; ++turn)
      counts[at] += counts[turn * kUpperClasses + at];
  }
  counts.resize(kUpperClasses);
  return counts;
}

Sums sums_of(std::span<const float> values) {
  Sums sums = parallel_ordered_reduce(
      static_cast<std::int64_t>(values.size()), grain_of(values.size()), Sums{},
      [&](std::int64_t begin, std::int64_t end, Sums s) {
        const auto own =
            values.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
        s.upper = upper_histogram(own);
        FiniteSums finite;
        finite.add(own);
        s.max_finite = finite.max();
        s.squares = finite.squares();
        return s;
      },
      [](Sums a, const Sums& b) {
        return Sums{0, std::max(a.max_finite, b.max_finite), a.squares + b.squares,
                    sum_of(std::move(a.upper), b.upper)};
      });
  // What lies above infinity is no value.
  if (!sums.upper.empty()) {
    const auto end = sums.upper.begin() + class_of(std::numeric_limits<float>::infinity()) + 1;
    std::fill(end, sums.upper.end(), 0u);
    sums.count = std::accumulate(sums.upper.begin(), end, std::int64_t{0});
  }
  return sums;
}

constexpr std::size_t kRanks = 4;
using Ranks = std::array<std::int64_t, kRanks>;

// False only if no value of the block is of one of these classes: plain enough for vectors, as most
// blocks hold none.
constexpr std::int64_t kBlock = 16;
bool may_hold(std::span<const float> block, const std::array<std::uint32_t, kRanks>& classes) {
  std::uint32_t found = 0;
  for (const float value : block) {
    const std::uint32_t upper = class_of(value);
    for (const std::uint32_t one : classes) found |= upper == one ? 1u : 0u;
  }
  return found != 0;
}

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
        for (std::int64_t k = begin; k < end; k += kBlock) {
          const auto block = values.subspan(static_cast<std::size_t>(k),
                                            static_cast<std::size_t>(std::min(kBlock, end - k)));
          if (!may_hold(block, high)) continue;
          for (const float each : block) {
            const std::uint32_t value = bits(each);
            const std::size_t at = histogram_of(value >> 16);
            if (at < kRanks) ++counts[at * kLowerClasses + (value & 0xffffu)];
          }
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
  d.infinite = sums.upper[class_of(std::numeric_limits<float>::infinity())];
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
