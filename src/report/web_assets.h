// The page's own style and script, from web/, built into the library.
#pragma once

#include <string_view>

namespace plumb::report {

extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;

}  // namespace plumb::report
