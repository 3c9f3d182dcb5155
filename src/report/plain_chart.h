// Charts in panels as SVG, drawn without any library: for where none is at hand.
#pragma once

#include <string>
#include <vector>

#include "report/open_axis.h"

namespace plumb::report {

/// A place in units of the axes (decades of an OpenAxis).
struct PlainPoint {
  double x = 0.0, y = 0.0;
  std::string label;  // shown when a pointer rests on it; may be empty
};

struct PlainSeries {
  std::string name, colour;          // colour as SVG writes it
  std::string shape = "circle";      // as Vega names it: "square", "triangle-up" ...
  std::string dash{};                // of the line, as SVG writes it
  bool filled = true;                // the markers of the curve
  std::vector<PlainPoint> points{};  // small and pale
  std::vector<PlainPoint> curve{};   // large and joined in this order
};

struct PlainPanel {
  std::string title, x_label, y_label;
  OpenAxis x, y;
  bool diagonal = false;              // where x equals y
  std::vector<PlainPoint> front{};    // joined by steps: along x first
  std::vector<PlainSeries> series{};  // of all panels in one order
};

/// Panels side by side and below each other, 960 pixels wide together, the series' names below. The
/// same panels give the same bytes. Throws std::invalid_argument without a panel.
std::string plain_svg(const std::vector<PlainPanel>& panels, int columns = 2);

/// A cell of a grid: lines of text on a stripe of colour.
struct PlainCell {
  std::vector<std::string> lines;
  std::string colour;  // "" for none
};

struct PlainGrid {
  std::string title, x_label;
  std::vector<std::string> columns, rows;     // what stands above and before the cells
  std::vector<std::vector<PlainCell>> cells;  // of each row as many as there are columns
};

/// The grid as SVG, 960 pixels wide. Throws std::invalid_argument for a row of another length.
std::string plain_svg(const PlainGrid& grid);

}  // namespace plumb::report
