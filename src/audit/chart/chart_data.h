// All that the charts of a sweep show, as one table that the page and the templates read.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "audit/chart/summary.h"

namespace plumb::audit::chart {

/// One JSON object that begins with this cost, numbers to six digits, "inf" for +inf;
/// web/chart-data.js reads it. The same table gives the same bytes.
std::string chart_data(const RunTable& table, const std::vector<Setting>& settings,
                       std::size_t cost);

}  // namespace plumb::audit::chart
