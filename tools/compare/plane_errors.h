// How far one channel is from another, number by number.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace plumb::compare {

/// Over the pixels that were compared. Numbers are as stored; a NaN or an infinity takes no part in
/// any mean: the same one in both is equal, any other pair is unlike.
struct PlaneErrors {
  std::int64_t compared = 0;   // both finite
  std::int64_t differing = 0;  // of these
  std::int64_t alike = 0;      // the same NaN or infinity in both
  std::int64_t unlike = 0;     // NaN or infinite in one alone, or not the same
  double largest = 0.0, mean = 0.0, root_mean_square = 0.0;
  std::size_t worst = 0;  // first pixel with the largest difference
  std::size_t first_unlike = 0;

  bool equal() const { return differing == 0 && unlike == 0; }
  /// Peak signal-to-noise ratio of a peak of one, decibels; nothing where nothing differs.
  std::optional<double> psnr_db() const;
};

/// `mask`: pixels to compare, none is all. Same bits on any number of threads. Throws
/// std::invalid_argument if sizes differ.
PlaneErrors plane_errors(std::span<const float> reference, std::span<const float> candidate,
                         std::span<const std::uint8_t> mask = {});

}  // namespace plumb::compare
