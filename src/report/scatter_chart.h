// Points over two axes, as an SVG picture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/chart_axis.h"

namespace plumb::report {

struct ChartPoint {
  double x = 0.0, y = 0.0;  // finite, and > 0 along a logarithmic axis
  std::string label;        // shown when a pointer rests on it
};

/// Points of one kind. Each series of a chart has a colour and a marker of its own, which tell it
/// from the others where one of the two cannot be seen.
struct ChartSeries {
  std::string name;  // in the legend; without one the series does not stand there
  std::vector<ChartPoint> points;
  bool joined = false;  // by a line, in order of x; equal x in the order given
};

struct ScatterChart {
  static constexpr std::size_t kMostSeries = 6;

  std::string title, x_label, y_label;
  std::vector<ChartPoint> points;   // of no series: pale discs
  std::vector<ChartSeries> series;  // at most kMostSeries; the last lies on top
  AxisKind x_axis = AxisKind::Log10, y_axis = AxisKind::Log10;
  bool diagonal = false;        // where x equals y; both axes then have one kind and range
  std::optional<double> limit;  // a y that is marked from side to side
  std::string limit_label;      // at the left end of that mark, above it if there is room
};

/// The chart as a file of its own, 640 x 480 and as much more as its legend takes, axes in whole
/// decades or steps around the points; linear ones have zero on them. The same points give the same
/// bytes. Throws std::invalid_argument for a point or limit that is not finite, or not above zero
/// along a logarithmic axis, for more series than kMostSeries, and for a diagonal between axes of
/// two kinds; without points the axes are those of one decade or from 0 to 1.
std::string to_svg(const ScatterChart& chart);

/// Charts one below the other in one file, each 200 pixels high without its texts, for what is
/// measured at the same places. The legend stands once, above all. Throws as above, and if there is
/// no panel or the names of their series differ.
std::string svg_of_panels(std::span<const ScatterChart> panels);

}  // namespace plumb::report
