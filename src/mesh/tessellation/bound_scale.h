// Lengths as numbers of 8 bits, never less than they were.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace plumb::mesh::tessellation {

/// Codes 1 to 254 are unit_m 2^((code - 1) / 5), so that a code is less than 14.87 % more than what
/// it stands for; 0 is zero, 255 is no bound at all.
///
///   (1) value(code(x)) >= x for every x >= 0, and codes rise with x.
struct BoundScale {
  static constexpr std::uint8_t kNone = 255;

  double unit_m = 1.0;  // > 0

  double value(std::uint8_t code) const {
    if (code == 0) return 0.0;
    if (code == kNone) return std::numeric_limits<double>::infinity();
    const unsigned step = code - 1u;
    return unit_m * kFifths[step % 5] * static_cast<double>(std::uint64_t{1} << step / 5);
  }
  std::uint8_t code(double bound_m) const {
    if (!(bound_m > 0.0)) return 0;
    std::uint8_t low = 1, high = kNone;  // the least code that is enough
    while (low < high) {
      const auto middle = static_cast<std::uint8_t>((low + high) / 2);
      if (value(middle) >= bound_m) {
        high = middle;
      } else {
        low = static_cast<std::uint8_t>(middle + 1);
      }
    }
    return low;
  }

 private:
  // 2^(k / 5)
  static constexpr std::array<double, 5> kFifths{1.0, 1.148698354997035, 1.3195079107728942,
                                                 1.5157165665103982, 1.7411011265922482};
};

}  // namespace plumb::mesh::tessellation
