// Where a picture shows what no small movement of the other one explains.
#pragma once

#include <span>
#include <vector>

namespace plumb::compare {

/// Of each pixel, the largest over all channels, in the planes' numbers.
struct LocalDifference {
  /// Beyond what the other picture holds within a quarter of a pixel, straight lines between its
  /// pixels: 0 where the pictures differ by less than a sampler may move them. The smaller of both
  /// directions (candidate in reference, reference in candidate).
  std::vector<float> unexplained;
  /// Beyond what its 3 x 3 pixels around hold: 0 where an outline fell on its other side. The
  /// larger of both directions.
  std::vector<float> out_of_range;
  /// The same less the contrast of its 5 x 5 pixels around: what stands out alone, as a pinhole or
  /// a crack does in smooth ground. The larger of both directions; 0 where the contrast is larger.
  std::vector<float> isolated;
  /// Largest less smallest of the 5 x 5 pixels around, the larger of both pictures; 0 where
  /// nothing is unexplained or out of range.
  std::vector<float> contrast;
};

/// Details finer than pixels change by a part of the contrast around them with every shift: what is
/// unexplained counts where it is more than this share of it. Measured: docs/comparing.md.
inline constexpr float kContrastShare = 0.3f;

/// Planes of one size, width x height, finite numbers. Throws std::invalid_argument if sizes
/// differ. Same bits on any number of threads.
LocalDifference local_difference(std::span<const std::span<const float>> reference,
                                 std::span<const std::span<const float>> candidate, int width_px,
                                 int height_px);

}  // namespace plumb::compare
