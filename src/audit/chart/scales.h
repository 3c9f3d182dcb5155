// What the charts of a sweep measure by: the looks of series, costs, axes.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "report/open_axis.h"

namespace plumb::audit::chart {

/// How a series looks, so that no two of up to 56 methods, and no two of four variants of one, look
/// the same without colours either.
struct SeriesLook {
  std::string colour;  // of the method
  std::string shape;   // of the method, as Vega names it: "circle", "square" ...
  std::string dash;    // of the variant, as SVG writes it: "", "6 3" ...
  bool filled = true;  // the method's first variant is, the others are hollow
};

std::vector<SeriesLook> looks_of(const RunTable& table);

/// The cost that charts begin with: CPU time of drawing, or triangles where only shared times are
/// there, or else the first that a run has.
std::size_t first_cost(const RunTable& table);

/// Costs that at least one run with an error has.
std::vector<std::size_t> costs_there(const RunTable& table);

/// The axis around all runs' errors, or their costs.
report::OpenAxis error_axis(const RunTable& table);
report::OpenAxis cost_axis(const RunTable& table, std::size_t cost);
report::OpenAxis popping_axis(const RunTable& table);

/// What claims are about: a measure and its unit, "pixel-error, px".
struct ClaimMeasure {
  std::string name, unit;
  int claims = 0;
  report::OpenAxis axis;  // of claimed and measured
};

/// Sorted so that pixels come first, then those with more claims, then by name.
std::vector<ClaimMeasure> claim_measures(const RunTable& table);

}  // namespace plumb::audit::chart
