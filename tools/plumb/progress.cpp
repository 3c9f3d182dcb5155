#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace plumb::tool {
namespace {

constexpr double kWorthALine_s = 5.0, kBetweenLines_s = 10.0;

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

namespace {

// "1 h 05 min", "12 min", "40 s".
std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  if (whole >= 100) return fmt::format("{} min", (whole + 59) / 60);
  return fmt::format("{} s", whole);
}

}  // namespace

std::string progress_text(const std::string& what, std::size_t over, std::size_t parts,
                          double elapsed_s) {
  constexpr std::size_t kWidth = 30;
  const std::size_t filled = parts > 0 ? kWidth * over / parts : kWidth;
  const double left_s = elapsed_s / static_cast<double>(over) * static_cast<double>(parts - over);
  return fmt::format("[{}{}] {:3} %  {} of {} {}, {} left", std::string(filled, '='),
                     std::string(kWidth - filled, ' '), parts > 0 ? 100 * over / parts : 100, over,
                     parts, what, duration_text(left_s));
}

ProgressBar::ProgressBar(std::string what, std::size_t parts)
    : terminal_(::isatty(STDERR_FILENO) == 1),
      what_(std::move(what)),
      parts_(parts),
      begun_(Clock::now()),
      said_(begun_) {}

ProgressBar::~ProgressBar() { finish(); }

void ProgressBar::advance() {
  ++over_;
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> silent = now - said_, elapsed = now - begun_;
  if (silent.count() < (terminal_ ? 0.1 : kBetweenLines_s) || over_ >= parts_) return;
  said_ = now;
  const std::string text = progress_text(what_, over_, parts_, elapsed.count());
  say(terminal_ ? "\r\033[K" + text : text + "\n");
}

void ProgressBar::finish() {
  if (terminal_ && said_ != begun_) say("\r\033[K");
  said_ = begun_;
}

void warn(const std::string& text) { say(fmt::format("plumb: warning: {}\n", text)); }

}  // namespace plumb::tool
