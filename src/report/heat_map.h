// Pictures of how large a value is at each pixel.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "report/heat_scale.h"
#include "report/rgb_image.h"

namespace plumb::report {

struct HeatMapOptions {
  std::string title = "";  // printable ASCII
  std::string unit = "px";
  bool logarithmic = false;
  double low = 0.0;   // the scale's low end; a logarithmic one that is given none (0) begins at a
                      // thousandth of its high end
  double high = 0.0;  // its high end; 0: the limit, or where there is none the largest finite value
  /// Values above it (a claim's bound, say) have a colour of their own.
  std::optional<double> limit = std::nullopt;
  std::string infinite_name = "infinite";  // of what is +inf: a depth's sky, say
  Rgb infinite_colour = kInfiniteColour;
  int text_scale = 0;  // pixels a dot of the legend's letters; 0: by the picture's width
};

/// Of a legend that stands by itself in a page: readable in half of it, whatever the picture's
/// width.
inline constexpr int kPageLegendWidthPx = 640;
inline constexpr int kPageLegendTextScale = 2;

/// The scale that the pictures below use. A scale that would be empty (every value zero) ends at
/// low + 1. Throws std::invalid_argument unless low and high are finite and >= 0, and high is 0 or
/// above low.
HeatScale heat_scale(std::span<const double> values, const HeatMapOptions& options);

/// One pixel a value. width x height values, row by row from the top left; NaN: no value there.
/// Throws std::invalid_argument if the sizes do not fit, or as heat_scale does.
RgbImage heat_picture(int width, int height, std::span<const double> values,
                      const HeatMapOptions& options = {});

/// The legend alone, `width` pixels wide: title, maximum, the scale with its ticks and unit, and
/// how many values are over the limit, infinite or missing. width >= 1.
RgbImage heat_legend(int width, std::span<const double> values, const HeatMapOptions& options = {});

/// The picture with its legend below, in one image of the same width.
RgbImage heat_map(int width, int height, std::span<const double> values,
                  const HeatMapOptions& options = {});

}  // namespace plumb::report
