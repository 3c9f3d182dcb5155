// What plumb soundness prints.
#pragma once

#include <string>

#include "audit/soundness/soundness.h"

namespace plumb::tool {

/// The distribution of the draws, the tightness of each method, failures with the commands that
/// repeat them, and one sentence.
std::string soundness_text(const audit::soundness::Summary& summary);

/// The same as one JSON object.
///
/// command  the command line that makes it again
std::string soundness_json(const audit::soundness::Summary& summary,
                           const audit::soundness::Draws& draws, const std::string& command);

}  // namespace plumb::tool
