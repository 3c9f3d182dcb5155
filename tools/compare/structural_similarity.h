// SSIM: how alike the structure of two pictures is.
#pragma once

#include <cstdint>
#include <span>

#include "core/grid.h"

namespace plumb::compare {

/// Mean over all windows, in [-1, 1], 1 for equal pictures; the least of them, and where.
struct StructuralSimilarity {
  double mean = 1.0;
  double least = 1.0;
  int least_x = 0, least_y = 0;  // middle of that window, pixels from the top left
};

/// Of two planes of finite numbers in 0..1 (luma), width x height: windows of 11 x 11 pixels,
/// Gaussian of 1.5 pixels, K1 = 0.01, K2 = 0.03, those that lie wholly inside. A picture that is
/// smaller than a window has one as large as itself, the Gaussian cut to it. Same bits on any
/// number of threads. `mask`: windows whose middle it has as 0 do not count; none is all; where
/// none counts all numbers are 1. Throws std::invalid_argument if sizes differ or are zero. Source:
/// [Wang, Bovik, Sheikh & Simoncelli 2004], section III.
StructuralSimilarity structural_similarity(const Grid<float>& reference,
                                           const Grid<float>& candidate,
                                           std::span<const std::uint8_t> mask = {});

}  // namespace plumb::compare
