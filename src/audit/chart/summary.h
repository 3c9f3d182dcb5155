// What many runs say together: medians over views, the Pareto front.
#pragma once

#include <array>
#include <optional>
#include <span>
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

}  // namespace plumb::audit::chart
