// What many runs say together: medians over views, the Pareto front, who is cheapest.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "audit/chart/run_table.h"

namespace plumb::audit::chart {

/// A setting's error and its cost; the smaller the better.
struct ErrorAndCost {
  double error = 0.0, cost = 0.0;
};

/// Rows of the points that no other beats: none has both as small and one of them smaller. Of equal
/// points all are on the front; an infinite or missing (NaN) number is on none. Ascending in error,
/// then in row.
std::vector<int> pareto_front(std::span<const ErrorAndCost> points);

/// The middle value, or the mean of the middle two; +inf where one of these is. values not empty.
double median(std::vector<double> values);

/// All views of one terrain by one method at one tolerance.
struct Setting {
  int terrain = 0, series = 0;
  double tolerance = 0.0;
  int runs = 0;                    // with an error: a view of nothing has none
  bool shared = false;             // some of its times were taken while other runs went on
  std::optional<double> error_px;  // median; none where no run has one
  std::array<std::optional<double>, kCosts.size()> costs;  // medians over runs with an error
  std::array<bool, kCosts.size()> on_front{};              // of its terrain, in that cost
};

/// Sorted by terrain, series, tolerance; the fronts are of each terrain by itself.
std::vector<Setting> settings_of(const RunTable& table);

/// The cheapest setting of a kind of terrain that keeps its error.
struct Winner {
  int kind = 0;                // row of the kinds
  double limit_px = 0.0;       // every view's error is at most this
  int series = -1;             // -1: none keeps it
  double tolerance = 0.0;      // of the setting
  double cost = 0.0;           // median over the views
  int second = -1;             // the cheapest other series; -1: none
  double times_cheaper = 0.0;  // the second's cost over the winner's
};

/// Limits of error that winners are looked for at, pixels.
inline constexpr std::array<double, 7> kErrorLimits{0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0};

/// Kinds of terrain: smooth, alpine, urban, caves, then others in the order of the file.
std::vector<std::string> kinds_of(const RunTable& table);

/// For each kind and limit, by one cost. A setting competes if it was finished with that cost in
/// every view of that kind in which any setting was; where two cost the same, the earlier series
/// wins.
std::vector<Winner> winners_of(const RunTable& table, std::size_t cost);

}  // namespace plumb::audit::chart
