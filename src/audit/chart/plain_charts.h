// The charts of a sweep as plain SVG, for where the drawing library is missing.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "audit/chart/summary.h"

namespace plumb::audit::chart {

std::string plain_cost_chart(const RunTable& table, const std::vector<Setting>& settings,
                             std::size_t cost);
/// Of the first of claim_measures(). Throws std::invalid_argument where there is none.
std::string plain_claim_chart(const RunTable& table);
/// Of a row of paths_of() at the tolerance of first_asked(). Throws std::out_of_range for another.
std::string plain_path_chart(const RunTable& table, std::size_t cost, std::size_t path);
std::string plain_winner_chart(const RunTable& table, std::size_t cost);

}  // namespace plumb::audit::chart
