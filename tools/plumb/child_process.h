// Other programs that a command lets work for it.
#pragma once

#include <string>
#include <vector>

namespace plumb::tool {

struct ChildResult {
  int status = -1;     // the exit status; 128 + the signal's number; 127: there is no such program
  std::string output;  // standard output and standard error, as they came
};

/// Runs arguments[0] (a path, or a name looked up in PATH) without a shell, and waits for its end.
ChildResult run_child(const std::vector<std::string>& arguments);

/// The words of a line for a POSIX shell that has quotes and nothing else of a shell's: what
/// Invocation::command_line wrote. Throws InputError for a quote that is not closed.
std::vector<std::string> shell_words(const std::string& line);

/// An empty folder for files in between, gone with all in it when the object dies.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// The running program itself.
std::string own_program();

/// A file that comes with the command: beside it, or in ../share/plumb; "" where it is in neither.
std::string file_of_command(const std::string& name);

}  // namespace plumb::tool
