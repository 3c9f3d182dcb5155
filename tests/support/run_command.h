// Runs a program as a person at a shell would, and keeps what it said.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumb::testing {

struct CommandResult {
  int status = -1;  // the exit status; 128 + the signal's number if a signal ended it
  std::string out;  // standard output
  std::string err;  // standard error
};

struct CommandOptions {
  std::string folder = "";  // to run in; empty: where the test runs
  std::vector<std::pair<std::string, std::string>> environment = {};  // added to the test's own
  std::optional<int> signal = std::nullopt;                           // sent after `signal_after`
  std::chrono::milliseconds signal_after{0};
};

/// Runs arguments[0] (a path, or a name looked up in PATH) and waits for its end.
CommandResult run_command(const std::vector<std::string>& arguments,
                          const CommandOptions& options = {});

/// Runs the built `plumb` with these arguments.
CommandResult run_plumb(std::vector<std::string> arguments, const CommandOptions& options = {});

/// An empty folder that is gone when the object dies.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// Names of what lies in it, sorted, hidden files included.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

}  // namespace plumb::testing
