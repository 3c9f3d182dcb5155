// How many values lie over a bound.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace plumb::audit {

/// Of values that were rounded to float32, the largest of which is known to be over the bound: it
/// counts even where rounding hides that. None that was at most `bound` counts; NaN is no value.
inline std::int64_t count_above(std::span<const float> values, double bound) {
  auto limit = static_cast<float>(bound);
  if (limit < bound) limit = std::nextafter(limit, std::numeric_limits<float>::infinity());
  const auto count =
      std::count_if(values.begin(), values.end(), [&](float value) { return value > limit; });
  return std::max<std::int64_t>(1, count);
}

/// Of values that are float32 themselves.
inline std::int64_t count_above_exactly(std::span<const float> values, double bound) {
  return std::count_if(values.begin(), values.end(), [&](float value) { return value > bound; });
}

/// Of defects, those beyond a bound >= 0 that need not be whole.
inline std::int64_t beyond(std::int64_t defects, double bound) {
  return bound < static_cast<double>(defects) ? defects - static_cast<std::int64_t>(bound) : 0;
}

}  // namespace plumb::audit
