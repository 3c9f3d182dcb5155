#include "report/chart_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.h"

namespace plumb::report {
namespace {

double decades_of(double value) { return reproducible_log(value) / reproducible_log(10.0); }

std::string decade(int power) {
  if (power >= 0 && power <= 4) return fmt::format("{:.0f}", reproducible_pow(10.0, power));
  if (power < 0 && power >= -4)
    return fmt::format("{:.{}f}", reproducible_pow(10.0, power), -power);
  return fmt::format("1e{}", power);
}

// The least of 1, 2, 5, 10 ... that covers the span with six steps; at most one more at either end
// makes them whole.
double step_of(double least, double most) {
  const double wanted = std::max(most / 6 - least / 6, 1e-300);
  const double decade = reproducible_pow(10.0, std::floor(decades_of(wanted)));
  for (const double times : {1.0, 2.0, 5.0})
    if (times * decade >= wanted * (1.0 - 1e-9)) return times * decade;  // a power's rounding
  return 10.0 * decade;
}

}  // namespace

double ChartAxis::place_px(double value) const {
  const double at = kind == AxisKind::Log10 ? decades_of(value) : value / step;
  return begin_px + (end_px - begin_px) * (at - low) / (high - low);
}

double ChartAxis::tick_px(int tick) const {
  return begin_px + (end_px - begin_px) * (tick - low) / (high - low);
}

std::string ChartAxis::tick_text(int tick) const {
  return kind == AxisKind::Log10 ? decade(tick) : fmt::format("{:g}", tick * step);
}

ChartAxis axis_around(AxisKind kind, const std::vector<double>& values, double begin_px,
                      double end_px) {
  ChartAxis axis{kind, 0, 1, 1.0, begin_px, end_px};
  if (values.empty()) return axis;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  // A value a rounding error beyond a tick needs no further one.
  const auto down = [](double at) { return static_cast<int>(std::floor(at + 1e-9)); };
  const auto up = [](double at) { return static_cast<int>(std::ceil(at - 1e-9)); };
  if (kind == AxisKind::Log10) {
    axis.low = down(decades_of(*least));
    axis.high = std::max(axis.low + 1, up(decades_of(*most)));
    return axis;
  }
  const double low = std::min(*least, 0.0), high = std::max(*most, 0.0);
  if (low == high) return axis;
  axis.step = step_of(low, high);
  axis.low = down(low / axis.step);
  axis.high = std::max(axis.low + 1, up(high / axis.step));
  return axis;
}

}  // namespace plumb::report
