// The terrain at its coarsest, as the measure of how wrong a frame may look and still be of it.
#pragma once

#include <memory>
#include <vector>

#include "audit/truth.h"

namespace plumb::audit {

/// A terrain decimated, and its surface.
struct CoarseTruth {
  terrain::Heightfield field;
  HeightfieldTruth truth;

  /// Heights of the surface at about every `stride`-th sample, corners included; `stride` >= 1.
  CoarseTruth(const HeightfieldTruth& full, int stride);
  CoarseTruth(const CoarseTruth&) = delete;
  CoarseTruth& operator=(const CoarseTruth&) = delete;
};

/// Strides 2, 4, ... kCoarsestStride, without those of which nothing but one cell, or
/// more than 1024 along a side, would be left. A
/// surface that is farther from the terrain than each of them is no level of detail of it.
std::vector<std::unique_ptr<CoarseTruth>> coarse_truths(const HeightfieldTruth& full);

inline constexpr int kCoarsestStride = 64;

}  // namespace plumb::audit
