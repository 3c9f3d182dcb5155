#include "report/heat_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/number_text.h"
#include "core/reproducible_math.h"

namespace plumb::report {
namespace {

// Night blue, violet, blue, teal, green, straw, pale yellow, evenly spaced; lightness L* from 4
// to 96.
constexpr std::array<Rgb, 7> kControlPoints{{{12, 10, 40},
                                             {66, 28, 118},
                                             {44, 90, 160},
                                             {24, 142, 142},
                                             {88, 190, 98},
                                             {198, 220, 66},
                                             {255, 246, 176}}};

std::uint8_t mix(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::floor(a + (b - a) * share + 0.5));
}

// Ten to the power k, correctly rounded on every machine.
double power_of_ten(int k) { return *parse_number(fmt::format("1e{}", k)); }

// The largest k with 10^k <= value; value > 0 and finite.
int decade_of(double value) {
  int k = static_cast<int>(std::floor(reproducible_log(value) / reproducible_log(10.0)));
  while (k > -307 && power_of_ten(k) > value) --k;
  while (k < 307 && power_of_ten(k + 1) <= value) ++k;
  return k;
}

Tick tick(double value) { return {value, fmt::format("{:.6g}", value)}; }

// Multiples of the smallest round step that leaves at most `most` of them.
std::vector<Tick> linear_ticks(const HeatScale& scale, int most) {
  const double widest = scale.high - scale.low;
  for (int k = decade_of(widest) - 4;; ++k) {
    for (const int factor : {1, 2, 5}) {
      const double step = factor * power_of_ten(k);
      const double first = std::ceil(scale.low / step), last = std::floor(scale.high / step);
      if (last - first + 1 > most) continue;
      std::vector<Tick> ticks;
      for (double n = first; n <= last; ++n) ticks.push_back(tick(n * step + 0.0));
      return ticks;
    }
  }
}

// Every power of ten (and its 2 and 5 fold, should there be room), or every second, third, ... one.
std::vector<Tick> logarithmic_ticks(const HeatScale& scale, int most) {
  const int first = decade_of(scale.low), last = decade_of(scale.high);
  const auto collect = [&](int stride, std::initializer_list<int> factors) {
    std::vector<Tick> ticks;
    for (int k = first; k <= last; ++k) {
      if (stride > 1 && k % stride != 0) continue;
      for (const int factor : factors) {
        const double value = factor * power_of_ten(k);
        if (value >= scale.low && value <= scale.high) ticks.push_back(tick(value));
      }
    }
    return ticks;
  };
  std::vector<Tick> ticks = collect(1, {1, 2, 5});
  for (int stride = 1; static_cast<int>(ticks.size()) > most; ++stride)
    ticks = collect(stride, {1});
  return ticks;
}

}  // namespace

double scale_position(const HeatScale& scale, double value) {
  if (!(value > scale.low)) return 0.0;
  if (value >= scale.high) return 1.0;
  if (!scale.logarithmic) return (value - scale.low) / (scale.high - scale.low);
  const double low = reproducible_log(scale.low);
  return std::clamp((reproducible_log(value) - low) / (reproducible_log(scale.high) - low), 0.0,
                    1.0);
}

Rgb scale_colour(double position) {
  constexpr int kSteps = static_cast<int>(kControlPoints.size()) - 1;
  const double place = std::clamp(position, 0.0, 1.0) * kSteps;
  const int below = std::min(static_cast<int>(place), kSteps - 1);
  const Rgb a = kControlPoints[static_cast<std::size_t>(below)];
  const Rgb b = kControlPoints[static_cast<std::size_t>(below) + 1];
  const double share = place - below;
  return {mix(a.r, b.r, share), mix(a.g, b.g, share), mix(a.b, b.b, share)};
}

Rgb heat_colour(const HeatScale& scale, double value) {
  if (std::isnan(value)) return kNoValueColour;
  if (std::isinf(value) && value > 0.0) return kInfiniteColour;
  if (scale.limit && value > *scale.limit) return kOverLimitColour;
  return scale_colour(scale_position(scale, value));
}

std::vector<Tick> scale_ticks(const HeatScale& scale, int most) {
  require(scale.low < scale.high, "a scale's low end must lie below its high end, got {} and {}",
          scale.low, scale.high);
  require(!scale.logarithmic || scale.low > 0.0,
          "a logarithmic scale must begin above zero, got {}", scale.low);
  require(most >= 2, "a scale needs room for two ticks or more, got {}", most);
  return scale.logarithmic ? logarithmic_ticks(scale, most) : linear_ticks(scale, most);
}

HeatSummary summarise(std::span<const double> values, const std::optional<double>& limit) {
  HeatSummary summary;
  for (const double value : values) {
    if (std::isnan(value)) {
      ++summary.no_value;
    } else if (std::isinf(value)) {
      ++(value > 0.0 ? summary.infinite : summary.no_value);
    } else {
      if (summary.finite++ == 0 || value > summary.largest_finite) summary.largest_finite = value;
      if (limit && value > *limit) ++summary.over_limit;
    }
  }
  return summary;
}

}  // namespace plumb::report
