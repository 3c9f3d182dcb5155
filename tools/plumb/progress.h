// Tells a person who waits what is being done.
#pragma once

#include <chrono>
#include <cstddef>
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

/// How far a long work of many equal parts has come, on standard error: on a terminal one line,
/// rewritten, with a bar and the time left; elsewhere lines of their own, ten seconds apart.
class ProgressBar {
 public:
  /// what   "runs"
  /// parts  of the work, >= 0
  ProgressBar(std::string what, std::size_t parts);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// One more part is over.
  void advance();
  /// Takes the line away.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  std::string what_;
  std::size_t parts_, over_ = 0;
  Clock::time_point begun_, said_;
};

/// "[=====     ]  50 %  6 of 12 runs, 5 s left": after `elapsed_s` seconds, over > 0 of which
/// `over` parts took.
std::string progress_text(const std::string& what, std::size_t over, std::size_t parts,
                          double elapsed_s);

/// One line on standard error that a user should see whatever is printed elsewhere.
void warn(const std::string& text);

}  // namespace plumb::tool
