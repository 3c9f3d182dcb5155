// The charts of a sweep as plain SVG, for where the drawing library is missing.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "audit/chart/summary.h"

namespace plumb::audit::chart {

/// Which camera path, and at which tolerance, the chart along a path shows.
struct PathChoice {
  int terrain = 0, camera = 0;
  double tolerance = 1.0;  // the nearest one that a method has to this is shown, by ratio
};

/// Paths of the table, in the order of terrains and cameras.
std::vector<PathChoice> paths_of(const RunTable& table);

/// Each "" where the table has nothing to show: no claims, no path.
std::string plain_cost_chart(const RunTable& table, const std::vector<Setting>& settings,
                             std::size_t cost);
std::string plain_claim_chart(const RunTable& table);
std::string plain_path_chart(const RunTable& table, std::size_t cost);
std::string plain_winner_chart(const RunTable& table, std::size_t cost);

}  // namespace plumb::audit::chart
