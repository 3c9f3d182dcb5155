// plumb compare --calibrate: limits from pairs that should pass, and what they would catch;
// --detection: what a profile catches as it is.
#pragma once

#include <string>

#include "command.h"
#include "compare/profile.h"

namespace plumb::tool {

struct DetectionRun {
  bool calibrate = true;  // else --detection
  std::string reference,
      candidate;       // pictures or folders that should pass; empty: generated scenes
  std::string output;  // the profile's file; empty: none
  int seeds = 10;
  bool with_others = false;
  bool json = false;
};

/// Prints the proposed limits, if there are any, and the table of what the profile catches. Exit
/// status 0; 1 if they let a defect pass or fail what is harmless, or a pair cannot be passed by
/// any limit.
int run_detection(const DetectionRun& run, const compare::Profile& base,
                  const Invocation& invocation);

}  // namespace plumb::tool
