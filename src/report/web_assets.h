// The page's own style and script, from web/, built into the library.
#pragma once

#include <string_view>

namespace plumb::report {

extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;
extern const std::string_view kChartStyle;
extern const std::string_view kChartScript;
extern const std::string_view kChartDataScript;  // of the page and of print files
extern const std::string_view kPrintScript;      // makes print files, under node

/// A Vega specification of web/charts by its name; empty if there is none.
std::string_view chart_template(std::string_view name);

}  // namespace plumb::report
