// Runs what a plan lists, several runs at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "audit/method.h"
#include "audit/sweep/plan.h"

namespace plumb::audit::sweep {

struct RunnerOptions {
  int threads = 1;     // runs at a time, >= 1; each has one thread
  int draws = 1;       // of each run, of which times are the median, >= 1
  bool timed = false;  // nothing else runs meanwhile: threads is 1
  std::int64_t frame_bytes = std::int64_t{1} << 29;  // of cast frames kept for other runs
};

/// Called with the line of each run that is over, never by two threads at once.
using LineListener = std::function<void(const std::string& line)>;

/// Makes the line of every run wanted; those that are skipped come first.
///
/// runs  indices of plan.runs
///
///   (1) A terrain's truth, what a method makes of it, and the truth seen by a camera are made once
///       and shared by all runs that need them. At the same time there are: the terrains with runs
///       left and their truths; at most `threads` prepared methods; `frame_bytes` of cast frames
///       besides those in use (what is beyond that is cast again); and `threads` runs, each of
///       kAuditBytes a pixel and its drawn surface.
///   (2) Lines have the same bytes, `timing` apart, whatever the options, and whatever else is run.
///   (3) A run that ends in an error has a line that says so, and the others go on.
/// Throws what the listener throws, once the runs that are under way have ended.
void run_sweep(const SweepPlan& plan, const std::vector<std::size_t>& runs,
               const MethodTable& table, const RunnerOptions& options, const LineListener& on_line);

}  // namespace plumb::audit::sweep
