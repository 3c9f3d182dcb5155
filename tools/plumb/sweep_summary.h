// What a file of a sweep's results holds, in a few lines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "audit/sweep/result_file.h"

namespace plumb::tool {

/// Runs with the same status and error.
struct SweepReason {
  std::string status, error;
  std::size_t runs = 0;
  std::string first;  // of them, for people
};

struct SweepSummary {
  std::size_t done = 0, failed = 0, skipped = 0;
  std::size_t broken = 0;            // of those done, claims that were not kept
  std::vector<SweepReason> reasons;  // why runs are not done, failures first
};

SweepSummary summary_of(const std::vector<audit::sweep::ResultLine>& lines);

/// "12 runs: 8 done, 4 skipped", then a line for each reason.
std::string summary_text(const SweepSummary& summary);

/// The same as one JSON object: schema, command, file, runs, done, broken, failed, skipped,
/// reasons.
std::string summary_json(const SweepSummary& summary, const std::string& schema,
                         const std::string& command, const std::string& file);

}  // namespace plumb::tool
