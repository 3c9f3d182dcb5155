// What was found in scenes as cells of a table and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/stability/run_scene.h"

namespace plumb::audit::stability {

/// The reading of a variant with its unit, and the verdict: "2.31 px, broken"; "refused"; "-" where
/// there is no such variant.
std::string measured_text(const SceneRun& run, const std::optional<VariantRun>& variant,
                          const std::optional<Expected>& expected);
/// "1 px", "nothing" where no claim speaks of the reading, "-".
std::string claimed_text(const SceneRun& run, const std::optional<VariantRun>& variant,
                         const std::optional<Expected>& expected);
/// What was stated: "broken, pixel-error at least 2 px".
std::string expected_text(const Scene& scene, const Expected& expected);

/// A number of the expected reading with its unit: "2.31 px".
std::string number_text(const SceneRun& run, const Expected& expected, double value);
/// "61 of 62 scenes are as expected."
std::string summary_text(const std::vector<SceneRun>& runs);

/// One JSON object, schema "plumb.stability/1", ending in a line feed; infinite and missing numbers
/// are null.
///
/// command  the command line that makes it again
///   (1) The same bytes on every machine and number of threads.
std::string gallery_json(const std::vector<SceneRun>& runs, const std::string& command);

}  // namespace plumb::audit::stability
