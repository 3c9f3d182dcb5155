// The charts' numbers, to be read and quoted.
#pragma once

#include <string>

#include "audit/chart/run_table.h"

namespace plumb::audit::chart {

/// Markdown: for each terrain and series which claims are broken and by how much; for each kind of
/// terrain and series the cost (a row of kCosts) of keeping an error in every view.
std::string chart_tables(const RunTable& table, std::size_t cost, const std::string& command);

}  // namespace plumb::audit::chart
