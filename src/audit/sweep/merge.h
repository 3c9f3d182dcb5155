// Results of a sweep joined, ordered and matched with what a scene asks.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "audit/sweep/plan.h"
#include "audit/sweep/result_file.h"

namespace plumb::audit::sweep {

struct NamedResults {
  std::string name;  // of the file
  std::vector<ResultLine> lines;
};

/// The lines of parts of one sweep, in the scene's order, each run once. Where several parts have a
/// run, the first one that was timed alone is taken, or else the first.
///
/// Throws InputError that names the key of a run with different results, and two runs that claim
/// the same place in the order: they belong to different scenes.
std::vector<ResultLine> merged(const std::vector<NamedResults>& parts);

/// Lines of a file that a sweep goes on with.
struct Resumed {
  std::vector<ResultLine> kept;    // runs of the plan, in their order there, with its indices
  std::vector<ResultLine> others;  // that the plan does not have
  std::vector<ResultLine> stale;   // of the plan, to be run again: see RerunOptions
};

struct RerunOptions {
  bool failed = false;        // runs that failed
  bool shared_times = false;  // runs that were not timed alone
};

/// Throws InputError as merged() does for a key with different results.
Resumed resumed(const SweepPlan& plan, const std::vector<ResultLine>& lines,
                const RerunOptions& rerun);

}  // namespace plumb::audit::sweep
