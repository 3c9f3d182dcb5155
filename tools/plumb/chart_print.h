// Charts as files for print: by Vega under node, or plain where one of these is missing.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/chart_page.h"

namespace plumb::tool {

/// Writes NAME.svg and NAME.png of each chart into the folder; adds their names to `files`, and to
/// `left_out` what could not be made, with the reason. Throws InputError where a file cannot be
/// written.
void print_charts(const std::string& folder, const audit::chart::PageInput& input,
                  std::vector<std::string>& files, std::vector<std::string>& left_out);

}  // namespace plumb::tool
