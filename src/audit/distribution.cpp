#include "audit/distribution.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

constexpr std::int64_t kGrain = 1 << 16;
using Histogram = std::vector<std::int64_t>;

struct Sums {
  std::int64_t count = 0, infinite = 0;
  double max_finite = 0.0, squares = 0.0;
};

constexpr std::size_t kClasses = 65536;  // of sixteen bits

// How many values fall into each of the classes that `class_of` names; a negative class is none.
template <class ClassOf>
Histogram count_classes(const std::vector<float>& values, std::size_t classes,
                        const ClassOf& class_of) {
  const auto accumulate = [&](std::int64_t begin, std::int64_t end, Histogram counts) {
    if (counts.empty()) counts.assign(classes, 0);
    for (std::int64_t k = begin; k < end; ++k) {
      const int at = class_of(values[static_cast<std::size_t>(k)]);
      if (at >= 0) ++counts[static_cast<std::size_t>(at)];
    }
    return counts;
  };
  const auto join = [](Histogram a, const Histogram& b) {
    if (a.empty()) return b;
    for (std::size_t k = 0; k < b.size(); ++k) a[k] += b[k];
    return a;
  };
  const auto size = static_cast<std::int64_t>(values.size());
  return parallel_ordered_reduce(size, std::max<std::int64_t>(kGrain, size / 16), Histogram{},
                                 accumulate, join);
}

// Bits of floats >= 0 (and +inf) order as the floats do.
std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value);
}

constexpr std::size_t kRanks = 4;
using Ranks = std::array<std::int64_t, kRanks>;

// The values of the given ranks (from 0), found by their upper and then their lower sixteen bits,
// all of them in one pass.
std::array<double, kRanks> values_of_ranks(const std::vector<float>& values, const Histogram& upper,
                                           Ranks ranks) {
  std::array<std::uint32_t, kRanks> high{};
  std::array<std::uint32_t, kRanks> group{};  // ranks with the same upper bits share a histogram
  std::vector<std::uint32_t> groups;
  for (std::size_t r = 0; r < kRanks; ++r) {
    for (; upper[high[r]] <= ranks[r]; ++high[r]) ranks[r] -= upper[high[r]];
    const auto known = std::find(groups.begin(), groups.end(), high[r]);
    group[r] = static_cast<std::uint32_t>(known - groups.begin());
    if (known == groups.end()) groups.push_back(high[r]);
  }
  const Histogram lower = count_classes(values, groups.size() * kClasses, [&](float value) {
    if (std::isnan(value)) return -1;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (bits(value) >> 16 == groups[g])
        return static_cast<int>(g * kClasses + (bits(value) & 0xffffu));
    }
    return -1;
  });
  std::array<double, kRanks> found{};
  for (std::size_t r = 0; r < kRanks; ++r) {
    std::uint32_t low = 0;
    for (; lower[group[r] * kClasses + low] <= ranks[r]; ++low)
      ranks[r] -= lower[group[r] * kClasses + low];
    found[r] = std::bit_cast<float>((high[r] << 16) | low);
  }
  return found;
}

}  // namespace

Distribution distribution_of(const std::vector<float>& values) {
  const Sums sums = parallel_ordered_reduce(
      static_cast<std::int64_t>(values.size()), kGrain, Sums{},
      [&](std::int64_t begin, std::int64_t end, Sums s) {
        for (std::int64_t k = begin; k < end; ++k) {
          const double value = values[static_cast<std::size_t>(k)];
          if (std::isnan(value)) continue;
          ++s.count;
          if (std::isinf(value)) {
            ++s.infinite;
          } else {
            s.max_finite = std::max(s.max_finite, value);
            s.squares += value * value;
          }
        }
        return s;
      },
      [](Sums a, const Sums& b) {
        return Sums{a.count + b.count, a.infinite + b.infinite,
                    std::max(a.max_finite, b.max_finite), a.squares + b.squares};
      });
  Distribution d;
  d.count = sums.count;
  d.infinite = sums.infinite;
  if (d.count == 0) return d;
  d.max_finite = sums.max_finite;
  d.max = d.infinite > 0 ? std::numeric_limits<double>::infinity() : d.max_finite;
  if (d.count > d.infinite)
    d.rms = std::sqrt(sums.squares / static_cast<double>(d.count - d.infinite));
  const Histogram upper = count_classes(values, kClasses, [](float value) {
    return std::isnan(value) ? -1 : static_cast<int>(bits(value) >> 16);
  });
  // Nearest rank: the smallest value that at least `share` of all values do not exceed; share as
  // thousandths, exactly.
  const auto rank = [&](std::int64_t thousandths) {
    return (d.count * thousandths + 999) / 1000 - 1;
  };
  const std::array<double, kRanks> found =
      values_of_ranks(values, upper, {rank(500), rank(950), rank(990), rank(999)});
  d.p50 = found[0];
  d.p95 = found[1];
  d.p99 = found[2];
  d.p999 = found[3];
  return d;
}

}  // namespace plumb::audit
