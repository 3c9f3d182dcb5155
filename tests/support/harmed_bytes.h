// Bytes of a file as damage leaves them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/byte_stream.h"
#include "support/random_scene.h"

namespace plumb::test_support {

inline std::uint8_t other_byte(Random& random, std::uint8_t byte) {
  return static_cast<std::uint8_t>(byte ^ random.integer(1, 255));
}

/// A few bytes replaced, removed or put in.
inline void harm(Random& random, Bytes& bytes) {
  for (int k = random.integer(1, 4); k > 0 && !bytes.empty(); --k) {
    const int at = random.integer(0, static_cast<int>(bytes.size()) - 1);
    switch (random.integer(0, 9)) {
      case 0:
        bytes.resize(static_cast<std::size_t>(at));
        break;
      case 1:
        bytes.insert(bytes.begin() + at, static_cast<std::uint8_t>(random.integer(0, 255)));
        break;
      case 2:
        std::fill(bytes.begin() + at, bytes.end(), std::uint8_t{255});
        break;
      default:
        bytes[static_cast<std::size_t>(at)] =
            other_byte(random, bytes[static_cast<std::size_t>(at)]);
    }
  }
}

}  // namespace plumb::test_support
