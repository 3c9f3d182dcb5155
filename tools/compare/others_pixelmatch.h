// What pixelmatch counts.
#pragma once

#include <cstdint>

#include "image/colour_image.h"

namespace plumb::compare {

/// Pixels whose colours are further apart than a threshold.
struct PixelmatchCounts {
  std::int64_t all = 0;        // each such pixel
  std::int64_t remaining = 0;  // without those that look like the edge of a smoothed outline
};

/// The distance is one of luma and chroma (YIQ) of the numbers as stored; threshold in [0, 1], of
/// the largest distance there is.
///
///   (1) Reference and candidate may be exchanged.
/// Throws std::invalid_argument if the threshold is not in [0, 1], and as require_judgeable does.
/// Source: [pixelmatch, index.js], version 7.2.
PixelmatchCounts pixelmatch_counts(const image::Rgb8Image& reference,
                                   const image::Rgb8Image& candidate, double threshold = 0.1);

}  // namespace plumb::compare
