// Lengths as numbers of 8 bits, never less than they were.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace plumb::mesh::tessellation {

/// Codes 1 to 254 are unit_m 2^((code - 1) / 8), so that a code is less than 9.06 % more than what
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
    return unit_m * kEighths[step % 8] * static_cast<double>(std::uint64_t{1} << step / 8);
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
  // 2^(k / 8)
  static constexpr std::array<double, 8> kEighths{1.0,
                                                  1.0905077326652577,
                                                  1.189207115002721,
                                                  1.2968395546510096,
                                                  1.4142135623730951,
                                                  1.5422108254079407,
                                                  1.681792830507429,
                                                  1.8340080864093424};
};

}  // namespace plumb::mesh::tessellation
