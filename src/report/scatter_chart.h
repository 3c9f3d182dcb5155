// Points over two logarithmic axes, as an SVG picture.
#pragma once

#include <string>
#include <vector>

namespace plumb::report {

struct ChartPoint {
  double x = 0.0, y = 0.0;  // finite, > 0
  std::string label;        // shown when a pointer rests on it
};

struct ScatterChart {
  std::string title, x_label, y_label;
  std::vector<ChartPoint> points;
  bool diagonal = false;  // where x equals y; both axes then have one range
};

/// The chart as a file of its own, 640 x 480, axes in whole decades around the points. The same
/// points give the same bytes. Throws std::invalid_argument for a point that is not finite and
/// above zero; without points the axes are those of one decade.
std::string to_svg(const ScatterChart& chart);

}  // namespace plumb::report
