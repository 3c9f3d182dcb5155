// Where terrain must be seen, where sky must be, and where either may: the sure way to find cracks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "image/plane_image.h"

namespace plumb::compare {

/// 1 where a picture shows terrain: depth is finite (Z; +inf is sky), else alpha is at least one
/// half (A). Nothing where it has neither channel.
std::optional<std::vector<std::uint8_t>> shown_terrain(const image::PlaneImage& picture);

/// What the candidate shows where the reference leaves no choice.
struct CoverageErrors {
  std::int64_t must_be_terrain = 0, must_be_sky = 0, undecided = 0;  // pixels of the reference
  std::int64_t holes = 0;                                            // sky where terrain must be
  std::int64_t overshoot = 0;                                        // terrain where sky must be
  std::vector<std::size_t> wrong;  // all of them, in the order of their rows
};

/// A pixel of the reference must be terrain if it and all neighbours within `band_px` (>= 0, in x
/// and y) are, must be sky likewise, and is undecided else. Throws std::invalid_argument if sizes
/// differ.
CoverageErrors check_coverage(std::span<const std::uint8_t> reference,
                              std::span<const std::uint8_t> candidate, int width_px, int height_px,
                              int band_px = 1);

}  // namespace plumb::compare
