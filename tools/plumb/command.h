// What a subcommand is, and the list of them: one file and one row each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "options.h"

namespace plumb::tool {

/// How the command was called.
struct Invocation {
  std::vector<std::string> arguments;  // the first is the program's name
  /// The same as a line for a POSIX shell, with "plumb" for the program's name: what a result holds
  /// to be made again.
  std::string command_line() const;
};

/// What a subcommand does once its options are read; returns the exit status: 0 all well, 1 a
/// finding. Throws InputError or std::invalid_argument for what ends in status 2.
using Action = std::function<int(const Invocation&)>;

struct Command {
  std::string name;                         // "info"
  std::string summary;                      // one line
  std::string example;                      // a shell line that works as printed
  std::function<Action(Options&)> declare;  // declares the options, and hands over what to do
};

/// All subcommands in the order of the help.
std::vector<Command> all_commands();

/// What the command line asks for: `action`, or where that is empty `answer` to be printed (help).
struct Request {
  Action action;
  std::string answer;
  bool version = false;
  bool json = false;  // of --version
};

/// Reads the command line. Throws InputError, one line, for what is wrong with it.
Request read_command_line(const std::vector<Command>& commands, const Invocation& invocation);

/// Runs the whole command and returns its exit status: 0, 1, or 2 after one line on standard error.
int run_command_line(const std::vector<Command>& commands, const Invocation& invocation);

// One file a subcommand.
Command info_command();
Command truth_command();
Command render_command();
Command audit_command();
Command compare_command();
Command golden_command();
Command profile_command();
Command build_command();
Command decode_command();
Command chart_command();
Command plan_command();
Command sweep_command();
Command merge_command();
Command stability_command();
Command soundness_command();

}  // namespace plumb::tool
