// Checks of a caller's arguments: what must hold, and what came.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace plumb {

/// Throws std::invalid_argument with the formatted message unless `condition` holds.
/// The message says what must hold and what came: "tile_size must be >= 1, got 0".
template <class... Args>
void require(bool condition, fmt::format_string<Args...> message, Args&&... args) {
  if (!condition) throw std::invalid_argument(fmt::format(message, std::forward<Args>(args)...));
}

/// A file, or an argument of the command line, that cannot be used: one line with what, where and
/// what was expected.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class... Args>
[[noreturn]] void input_error(fmt::format_string<Args...> message, Args&&... args) {
  throw InputError(fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace plumb
