// What keeping an error costs, and who does it cheapest.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "audit/chart/run_table.h"

namespace plumb::audit::chart {

/// Limits of error that are looked at, pixels.
inline constexpr std::array<double, 7> kErrorLimits{0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0};

/// Kinds of terrain: smooth, alpine, urban, caves, then others in the order of the file.
std::vector<std::string> kinds_of(const RunTable& table);

/// The cheapest tolerance of a series at which every view of a kind of terrain keeps an error.
struct Cheapest {
  int kind = 0;           // row of the kinds
  double limit_px = 0.0;  // every view's error is at most this
  int series = 0;
  double tolerance = 0.0;  // asked for
  double cost = 0.0;       // median over the views
};

/// For each kind and limit those series that keep it, the cheapest first, by one cost (a row of
/// kCosts). A tolerance competes if it was finished with that cost in every view of that kind in
/// which any was, and no pixel of any is wrong: an error is of what is there. Of equal costs the
/// earlier series, then the smaller tolerance, comes first.
std::vector<Cheapest> cheapest_of(const RunTable& table, std::size_t cost);

/// The cheapest of a kind of terrain that keeps its error.
struct Winner {
  int kind = 0;                // row of the kinds
  double limit_px = 0.0;       // every view's error is at most this
  int series = -1;             // -1: none keeps it
  double tolerance = 0.0;      // asked for
  double cost = 0.0;           // median over the views
  int second = -1;             // the cheapest other series; -1: none
  double times_cheaper = 0.0;  // the second's cost over the winner's
};

/// For each kind and limit, by one cost.
std::vector<Winner> winners_of(const RunTable& table, std::size_t cost);

}  // namespace plumb::audit::chart
