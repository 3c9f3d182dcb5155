// Tells a person who waits what is being done.
#pragma once

#include <chrono>
#include <string>

namespace plumb::tool {

/// One line on standard error that names the step at work. On a terminal it is rewritten and gone
/// at the end; elsewhere a step is a line of its own, and only if it took more than five seconds.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The step before this one, if any, is over.
  void step(const std::string& name);
  /// All is over: takes the line away. Whoever prints to a terminal calls it first.
  void finish();

 private:
  bool terminal_;
  std::string name_;
  std::chrono::steady_clock::time_point begun_;
};

/// One line on standard error that a user should see whatever is printed elsewhere.
void warn(const std::string& text);

}  // namespace plumb::tool
