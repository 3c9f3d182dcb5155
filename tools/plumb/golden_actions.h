// What plumb golden does: one function an action.
#pragma once

#include <string>
#include <vector>

#include "command.h"

namespace plumb::tool {

struct GoldenOptions {
  std::string action, name, subject;  // subject: of add, a scene or a picture
  std::string folder = "tests/golden";
  std::string actual;     // the folder of another program's pictures; empty: none
  std::string tolerance;  // of add; empty: "none"
  std::string why, output, junit;
  bool accept = false;
  bool as_picture = false;
  bool json = false;
  int threads = 0;
};

/// Each returns the exit status. All throw InputError for what ends in status 2; `golden_check`
/// does so after every case was checked and everything was printed and written.
int golden_check(const GoldenOptions& options, const Invocation& invocation);
int golden_update(const GoldenOptions& options, const Invocation& invocation);
int golden_add(const GoldenOptions& options);
int golden_list(const GoldenOptions& options, const Invocation& invocation);

}  // namespace plumb::tool
