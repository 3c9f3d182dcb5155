#include "report/open_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/reproducible_math.h"

namespace plumb::report {
namespace {

constexpr double kApart = 0.125;    // of zero and infinity from the rest
constexpr int kFineDecades = 3;     // so many at most have ticks between the powers of ten
constexpr int kMostTicks = 9;       // of powers of ten
constexpr double kRounding = 1e-9;  // of a logarithm: a value on a tick needs no further one

double decades_of(double value) { return reproducible_log(value) / reproducible_log(10.0); }

// 1, 2 or 5 times a power of ten, counted along the axis: 0 is 1, 1 is 2, 2 is 5, 3 is 10.
double place_of_step(int step) {
  static const double kWithin[3] = {0.0, decades_of(2.0), decades_of(5.0)};
  const int decade = static_cast<int>(std::floor(step / 3.0));
  return decade + kWithin[step - 3 * decade];
}

std::string text_of_step(int step) {
  static const int kTimes[3] = {1, 2, 5};
  const int decade = static_cast<int>(std::floor(step / 3.0));
  const int times = kTimes[step - 3 * decade];
  if (decade > 4 || decade < -3) return fmt::format("{}e{}", times, decade);
  if (decade >= 0) return fmt::format("{:.0f}", times * reproducible_pow(10.0, decade));
  return fmt::format("{:.{}f}", times * reproducible_pow(10.0, decade), -decade);
}

int step_below(double at) {
  int step = 3 * static_cast<int>(std::floor(at)) + 3;
  while (place_of_step(step) > at + kRounding) --step;
  return step;
}

int step_above(double at) {
  int step = 3 * static_cast<int>(std::floor(at));
  while (place_of_step(step) < at - kRounding) ++step;
  return step;
}

void add_ticks(OpenAxis& axis, int first, int last) {
  if (last - first <= 3 * kFineDecades) {
    for (int step = first; step <= last; ++step)
      axis.ticks.push_back({place_of_step(step), text_of_step(step)});
    return;
  }
  const int decades = (last - first) / 3, every = (decades + kMostTicks - 1) / kMostTicks;
  for (int step = first; step <= last; step += 3 * every)
    axis.ticks.push_back({place_of_step(step), text_of_step(step)});
}

}  // namespace

double OpenAxis::place(double value) const {
  if (value == 0.0) return zero_at.value_or(low);
  if (std::isinf(value)) return infinite_at.value_or(high);
  return std::clamp(decades_of(value), first, last);
}

OpenAxis open_axis(std::span<const double> values) {
  double least = 0.0, most = 0.0;
  bool zero = false, infinite = false;
  for (const double value : values) {
    require(value >= 0.0, "a value of a logarithmic axis must be >= 0, got {}", value);
    zero |= value == 0.0;
    infinite |= std::isinf(value);
    if (value == 0.0 || std::isinf(value)) continue;
    least = least == 0.0 ? value : std::min(least, value);
    most = std::max(most, value);
  }
  int first = least > 0.0 ? step_below(decades_of(least)) : -3;
  int last = least > 0.0 ? step_above(decades_of(most)) : 0;
  if (last - first > 3 * kFineDecades) {
    first = 3 * static_cast<int>(std::floor(first / 3.0));
    last = 3 * static_cast<int>(std::ceil(last / 3.0));
  }
  if (last == first) ++last;
  OpenAxis axis;
  axis.low = axis.first = place_of_step(first);
  axis.high = axis.last = place_of_step(last);
  const double apart = kApart * (axis.last - axis.first);
  if (zero) {
    axis.zero_at = axis.first - apart;
    axis.low = axis.first - 1.5 * apart;
    axis.ticks.push_back({*axis.zero_at, "0"});
  }
  add_ticks(axis, first, last);
  if (infinite) {
    axis.infinite_at = axis.last + apart;
    axis.high = axis.last + 1.5 * apart;
    axis.ticks.push_back({*axis.infinite_at, "\xE2\x88\x9E"});
  }
  return axis;
}

}  // namespace plumb::report
