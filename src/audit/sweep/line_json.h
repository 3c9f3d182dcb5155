// Lines of a result file, as JSON.
#pragma once

#include <string>

#include "audit/audit.h"
#include "audit/sweep/plan.h"

namespace plumb::audit::sweep {

/// What is measured of a run apart from its result.
struct RunTiming {
  double prepare_wall_s = 0.0, prepare_cpu_s = 0.0;
  int draws = 1;
  double draw_wall_s = 0.0, draw_cpu_s = 0.0;  // medians
  double draw_wall_spread_s = 0.0, draw_cpu_spread_s = 0.0;
  bool shared = true;  // other runs used the machine meanwhile
};

/// The object `asked` of a run, as docs/formats/sweep-results.md has it; `asked` and `key` of the
/// run are not looked at.
std::string asked_text(const SweepPlan& plan, const PlannedRun& run, const std::string& version);

/// Lines for the run with this index, each without its line feed.
std::string done_line(const SweepPlan& plan, std::size_t run, const AuditResult& result,
                      const RunTiming& timing);
std::string failed_line(const SweepPlan& plan, std::size_t run, const std::string& error);
std::string skipped_line(const SweepPlan& plan, std::size_t run);

}  // namespace plumb::audit::sweep
