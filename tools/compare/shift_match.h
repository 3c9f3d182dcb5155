// Pixels that no like pixel nearby explains: what rasterisers that differ by a subpixel do not
// have.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plumb::compare {

/// How a pixel is looked for in the other picture.
struct ShiftMatchOptions {
  int radius_px = 1;       // pixels away at most, in x and in y, >= 0
  double tolerance = 0.0;  // of every channel, in the numbers of the planes
};

/// 1 for each pixel of either picture that has no like one within the radius in the other.
///
/// A defect up to twice the radius thick may be explained away: what it hides is on both sides of
/// it. Planes are of one size, width x height; a NaN is like a NaN, an infinity like itself.
/// Throws std::invalid_argument if sizes differ.
std::vector<std::uint8_t> unmatched_pixels(std::span<const std::span<const float>> reference,
                                           std::span<const std::span<const float>> candidate,
                                           int width_px, int height_px,
                                           const ShiftMatchOptions& options = {});

}  // namespace plumb::compare
