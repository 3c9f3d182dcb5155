#include "child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>

#include "core/check.h"

extern char** environ;

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;

// What a child is given in place of our own input and output.
struct Actions {
  posix_spawn_file_actions_t actions;
  Actions(int output) {
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, 1);
    ::posix_spawn_file_actions_adddup2(&actions, output, 2);
  }
  ~Actions() { ::posix_spawn_file_actions_destroy(&actions); }
};

std::string read_to_end(int from) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = ::read(from, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

}  // namespace

ChildResult run_child(const std::vector<std::string>& arguments) {
  require(!arguments.empty(), "a program to run must be named");
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) input_error("cannot start '{}': no pipe", arguments[0]);
  std::vector<char*> pointers;
  for (const std::string& argument : arguments)
    pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  pid_t child = -1;
  ChildResult result;
  const Actions given(ends[1]);
  const int failed =
      ::posix_spawnp(&child, pointers[0], &given.actions, nullptr, pointers.data(), environ);
  ::close(ends[1]);
  if (failed == 0) result.output = read_to_end(ends[0]);
  ::close(ends[0]);
  if (failed != 0) {
    result.status = 127;
    return result;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::vector<std::string> shell_words(const std::string& line) {
  std::vector<std::string> words;
  bool inside = false, quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (!quoted && c == ' ') {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c == '\'') {
      quoted = !quoted;
    } else if (c == '\\' && !quoted && k + 1 < line.size()) {
      words.back() += line[++k];
    } else {
      words.back() += c;
    }
  }
  if (quoted) input_error("a quote is not closed in the command \"{}\"", line);
  return words;
}

WorkFolder::WorkFolder() {
  std::string name = (fs::temp_directory_path() / "plumb-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) input_error("cannot make a folder '{}'", name);
  path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string own_program() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return failed ? "plumb" : program.string();
}

std::string file_of_command(const std::string& name) {
  const fs::path folder = fs::path(own_program()).parent_path();
  for (const fs::path& file : {folder / name, folder / ".." / "share" / "plumb" / name})
    if (fs::is_regular_file(file)) return file.lexically_normal().string();
  return "";
}

}  // namespace plumb::tool
