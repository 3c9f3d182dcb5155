// How long things took, for reports: no result depends on it.
#pragma once

#include <chrono>

namespace plumb {

class Stopwatch {
 public:
  /// Seconds since it was made or asked before.
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> taken = now - start_;
    start_ = now;
    return taken.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace plumb
