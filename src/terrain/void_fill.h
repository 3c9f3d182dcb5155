// Voids given the height of their nearest neighbour.
#pragma once

#include <cstdint>

#include "terrain/heightfield.h"

namespace plumb::terrain {

/// Gives every void the height of the nearest sample that is none, and returns how many there were.
///
///   (1) Distances are horizontal, in metres (spacings count). Of two samples equally far the one
///       in the lower column wins, then the one in the lower row.
///   (2) A terrain without voids, or of nothing else, stays as it is.
/// Linear in the number of samples; the same bits on any number of threads.
/// Source: [Felzenszwalb & Huttenlocher 2012, section 2], the exact distance transform by lower
/// envelopes of parabolas, with the row of the nearest sample kept beside each distance.
std::int64_t fill_voids(Heightfield& field);

}  // namespace plumb::terrain
