// From the command line to the exit status.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

#include "command.h"
#include "core/check.h"
#include "core/instruction_set.h"
#include "core/shell_text.h"
#include "version.h"

namespace plumb::tool {
namespace {

constexpr int kNoVerdict = 2;

// A message is one line, whatever a library put into it.
std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!space) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

int fail(std::string_view message) {
  std::cout.flush();
  const std::string line = fmt::format("plumb: {}\n", one_line(message));
  std::fwrite(line.data(), 1, line.size(), stderr);
  return kNoVerdict;
}

int act(const std::vector<Command>& commands, const Invocation& invocation) {
  instruction_set();  // a wrong PLUMB_ISA is an error whether or not a kernel runs
  const Request request = read_command_line(commands, invocation);
  int status = 0;
  if (request.version) {
    std::cout << (request.json ? version_json() : version_text());
  } else if (!request.action) {
    std::cout << request.answer;
  } else {
    status = request.action(invocation);
  }
  errno = 0;
  std::cout.flush();
  if (!std::cout || std::fflush(stdout) != 0) {
    input_error("cannot write to standard output: {}",
                errno != 0 ? std::strerror(errno) : "writing failed");
  }
  return status;
}

}  // namespace

std::string Invocation::command_line() const {
  std::vector<std::string> words = arguments;
  if (words.empty()) words.emplace_back();
  words.front() = "plumb";
  return shell_line(words);
}

int run_command_line(const std::vector<Command>& commands, const Invocation& invocation) {
  try {
    return act(commands, invocation);
  } catch (const std::bad_alloc&) {
    return fail("out of memory: the input is too large for this machine");
  } catch (const std::length_error&) {
    return fail("out of memory: the input is too large for this machine");
  } catch (const std::exception& error) {  // InputError and std::invalid_argument among them
    return fail(error.what());
  }
}

}  // namespace plumb::tool
