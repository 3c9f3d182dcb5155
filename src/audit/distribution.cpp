#include "audit/distribution.h"

#include <algorithm>
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

// How many values fall into each of the 65536 classes that `class_of` names; a negative class is
// none.
template <class ClassOf>
Histogram count_classes(const std::vector<float>& values, const ClassOf& class_of) {
  const auto accumulate = [&](std::int64_t begin, std::int64_t end, Histogram counts) {
    if (counts.empty()) counts.assign(65536, 0);
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

// The value of the given rank (from 0), found by its upper and then its lower sixteen bits.
double value_of_rank(const std::vector<float>& values, const Histogram& upper, std::int64_t rank) {
  std::uint32_t high = 0;
  for (; upper[high] <= rank; ++high) rank -= upper[high];
  const Histogram lower = count_classes(values, [&](float value) {
    return std::isnan(value) || bits(value) >> 16 != high ? -1
                                                          : static_cast<int>(bits(value) & 0xffffu);
  });
  std::uint32_t low = 0;
  for (; lower[low] <= rank; ++low) rank -= lower[low];
  return std::bit_cast<float>((high << 16) | low);
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
  const Histogram upper = count_classes(values, [](float value) {
    return std::isnan(value) ? -1 : static_cast<int>(bits(value) >> 16);
  });
  // Nearest rank: the smallest value that at least `share` of all values do not exceed; share as
  // thousandths, exactly.
  const auto percentile = [&](std::int64_t thousandths) {
    return value_of_rank(values, upper, (d.count * thousandths + 999) / 1000 - 1);
  };
  d.p50 = percentile(500);
  d.p95 = percentile(950);
  d.p99 = percentile(990);
  d.p999 = percentile(999);
  return d;
}

}  // namespace plumb::audit
