// How often each size of a value occurs, as an SVG picture.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plumb::report {

/// Finite values above zero, sorted into bins of one width from 0 to `high`. Zeros, which would
/// tower over the rest, and what is not finite are counted apart.
struct Histogram {
  double high = 1.0;                 // the last bin's end, which belongs to it
  std::vector<std::int64_t> counts;  // one a bin
  std::int64_t zero = 0;             // values <= 0
  std::int64_t infinite = 0;         // +inf
  std::int64_t no_value = 0;         // NaN

  friend bool operator==(const Histogram&, const Histogram&) = default;
};

/// `high` is the largest finite value, or 1 where none is above zero.
///
///   (1) Every value is counted once.
/// Throws std::invalid_argument if bins < 1.
Histogram histogram_of(std::span<const float> values, int bins);

struct HistogramChart {
  std::string title, x_label;
  std::string unit;  // behind each number of the axis; may be empty
  Histogram histogram;
  std::optional<double> limit;  // marked, and what lies wholly above it coloured, where on the axis
};

/// The chart as a file of its own, 640 x 320, counts on a logarithmic axis in whole decades, dark
/// where the viewer prefers that. The same numbers give the same bytes. Throws
/// std::invalid_argument if a count is negative, there is no bin, or `high` is not above zero.
std::string to_svg(const HistogramChart& chart);

}  // namespace plumb::report
