#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace plumb::tool {
namespace {

constexpr double kWorthALine_s = 5.0;

void say(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress() : terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { finish(); }

void Progress::step(const std::string& name) {
  finish();
  name_ = name;
  begun_ = std::chrono::steady_clock::now();
  if (terminal_) say(fmt::format("\r\033[K{} ...", name_));
}

void Progress::finish() {
  if (name_.empty()) return;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun_;
  if (terminal_) {
    say("\r\033[K");
  } else if (taken.count() > kWorthALine_s) {
    say(fmt::format("{}: {:.1f} s\n", name_, taken.count()));
  }
  name_.clear();
}

void warn(const std::string& text) { say(fmt::format("plumb: warning: {}\n", text)); }

}  // namespace plumb::tool
