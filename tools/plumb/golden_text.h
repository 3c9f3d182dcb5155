// What is said of golden cases: to people, to programs and to test servers.
#pragma once

#include <string>
#include <vector>

#include "golden_actions.h"
#include "golden_check.h"

namespace plumb::tool {

/// The shell lines that come next after a case that does not pass.
struct NextSteps {
  std::string see;     // writes the pictures and a report of them
  std::string accept;  // takes the picture as it is now for the reference; empty: there is none
};
NextSteps next_steps(const GoldenOptions& options, const GoldenCheck& check);

/// A row a case; then each one that is not the same bits: what differs in bits and in metrics, the
/// worst pixels with both values and patches, files, and the next steps. `strays` last.
std::string check_text(const GoldenOptions& options, const std::vector<GoldenCheck>& checks,
                       const std::vector<std::string>& strays);

/// The part of it that speaks of one case, the verdict first; without the metrics for somebody who
/// prints comparison_text below it.
std::string case_text(const GoldenOptions& options, const GoldenCheck& check,
                      bool with_metrics = true);

/// One object, schema "plumb.golden/1", with the same; the comparison as in compare_json, without
/// its command. A line end behind it.
std::string check_json(const GoldenOptions& options, const std::vector<GoldenCheck>& checks,
                       const std::vector<std::string>& strays, const std::string& command);

/// A suite with a case each: what differs, is missing or stale failed, what could not be checked is
/// an error, and so is each stray file.
std::string check_junit(const GoldenOptions& options, const std::vector<GoldenCheck>& checks,
                        const std::vector<std::string>& strays);

/// Throws InputError if options.output lies in the golden folder or in the other program's: what is
/// written there would be taken for theirs.
void require_place_of_its_own(const GoldenOptions& options);

/// Writes into FOLDER/NAME what there is of these, and says so in check.files:
///   golden.EXT, actual.EXT   copies of the reference and of the picture (of a drawn one EXR and
///   PNG) index.html, difference.png, ...   the report (compare::write_comparison)
/// Throws InputError if one cannot be written.
void write_case_files(const std::string& folder, const std::string& command, GoldenCheck& check);

}  // namespace plumb::tool
