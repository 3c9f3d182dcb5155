// The "fuzzy" comparison of the OpenGL and Vulkan conformance suites.
#pragma once

#include <cstdint>

#include "image/colour_image.h"

namespace plumb::compare {

/// The suites' pseudo-random numbers: Marsaglia's xorshift of four words, seeded their way.
/// Source: [VK-GL-CTS, framework/delibs/debase/deRandom.c].
class ConformanceRandom {
 public:
  explicit ConformanceRandom(std::uint32_t seed)
      : x_((0u - seed) ^ 123456789u),
        y_(362436069u * seed),
        z_(521288629u ^ (seed >> 7)),
        w_(88675123u ^ (seed << 3)) {}

  std::uint32_t next() {
    const std::uint32_t mixed = x_ ^ (x_ << 11);
    x_ = y_;
    y_ = z_;
    z_ = w_;
    w_ = w_ ^ (w_ >> 19) ^ mixed ^ (mixed >> 8);
    return w_;
  }
  /// In [0, 1]: the low 28 bits, rounded to a float.
  float unit() { return static_cast<float>(next() & 0xFFFFFFFu) * 0x1p-28f; }
  int integer(int low, int high) {  // both included
    return low + static_cast<int>(next() % static_cast<std::uint32_t>(high - low + 1));
  }

 private:
  std::uint32_t x_, y_, z_, w_;
};

/// Sum over the picture of the fourth powers of colour distances that no pixel nearby explains.
///
///   (1) 0 where no channel of the slightly blurred pictures differs by more than 4/255.
///   (2) A pixel counts only if neither picture has its colour within one pixel in the other.
/// Looks at about two pixels of nine, chosen by the suites' own sequence, and scales the sum up.
/// Throws std::invalid_argument as require_judgeable does.
/// Source: [VK-GL-CTS, framework/common/tcuFuzzyImageCompare.cpp].
double fuzzy_sum(const image::Rgb8Image& reference, const image::Rgb8Image& candidate);

}  // namespace plumb::compare
