// From values to colours: the scale of a heat map, and the ticks of its legend.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/rgb_image.h"

namespace plumb::report {

/// Values from `low` to `high` run through the colours, dark to light; what lies below or above
/// takes the end's colour. Logarithmic scales have low > 0.
struct HeatScale {
  double low = 0.0;
  double high = 1.0;  // > low
  bool logarithmic = false;
  std::optional<double> limit = std::nullopt;  // values above it have a colour of their own
};

inline constexpr Rgb kNoValueColour{128, 128, 128};  // NaN
inline constexpr Rgb kOverLimitColour{255, 48, 32};
inline constexpr Rgb kInfiniteColour{255, 0, 255};

/// Place of a value on the scale, 0 (low) to 1 (high), clamped; not for NaN.
double scale_position(const HeatScale& scale, double value);

/// Colour at a place of the scale, 0 to 1.
///
///   (1) Perceived lightness rises with the position.
///   (2) No colour of the scale is one of the three named above.
Rgb scale_colour(double position);

/// Colour of a value: NaN has no value, +inf and values above the limit have their own colours.
Rgb heat_colour(const HeatScale& scale, double value);

struct Tick {
  double value = 0.0;
  std::string label;  // without the unit
};

/// Round values between the scale's ends (1, 2, 5 times a power of ten; a linear scale's are evenly
/// spaced), in rising order, at most `most` of them. most >= 2.
std::vector<Tick> scale_ticks(const HeatScale& scale, int most);

/// What a legend says about the values.
struct HeatSummary {
  double largest_finite = 0.0;  // 0 where no value is finite
  std::size_t finite = 0;
  std::size_t over_limit = 0;  // finite ones
  std::size_t infinite = 0;
  std::size_t no_value = 0;
};

HeatSummary summarise(std::span<const double> values, const std::optional<double>& limit);

}  // namespace plumb::report
