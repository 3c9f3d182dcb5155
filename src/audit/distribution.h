// Errors as a distribution: the figures that a report gives of many.
#pragma once

#include <cstdint>
#include <span>

namespace plumb::audit {

/// Figures of a set of errors >= 0. Percentiles are nearest-rank over all values; an infinite error
/// counts as the largest.
struct Distribution {
  std::int64_t count = 0;
  std::int64_t infinite = 0;  // of them +inf: no counterpart, or behind the eye
  double max = 0.0;           // +inf if infinite > 0
  double max_finite = 0.0;
  double rms = 0.0;  // of the finite values
  double p50 = 0.0, p95 = 0.0, p99 = 0.0, p999 = 0.0;
};

/// `values` >= 0 or +inf; NaN entries are no values and skipped. Percentiles of float32 values are
/// exact; max and rms of doubles that were rounded to float32 on the way are those of the rounded
/// ones, so callers keep their exact maximum. The same bits on any number of threads.
Distribution distribution_of(std::span<const float> values);

}  // namespace plumb::audit
