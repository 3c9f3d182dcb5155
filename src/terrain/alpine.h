// A mountain range.
#pragma once

#include "terrain/generator_parameters.h"

namespace plumb::terrain {

/// Ridged multifractal: octaves of 1 - |gradient noise|, squared, each weighted by the one before,
/// so that ridges are rough and valley floors smooth; the coordinates bent by a slower noise.
///
/// Heights run from `height` (valley floors) to about `height` + `relief` (the highest summits of a
/// terrain many `feature` lengths wide; never above 1.6 times that). Ridges lie about `feature`
/// metres apart. Octaves halve that length down to two spacings.
/// Source: [Ebert et al. 2003, chapter 16], with a gain and a warp of our own.
RowFiller alpine(const GeneratorValues& values, const GridShape& shape);

}  // namespace plumb::terrain
