// A mountain range.
#pragma once

#include "terrain/generator_parameters.h"

namespace plumb::terrain {

/// Ridged multifractal: octaves of 1 - |gradient noise|, squared, each weighted by the one before,
/// so that ridges are rough and valley floors smooth; the coordinates bent by a slower noise.
///
/// Heights run from `height` (valley floors, level where the formula falls below) to about
/// `height` + `relief` (the highest summits of a terrain many features wide), and never above
/// `height` + `relief` * (1 / (1 - roughness) - 0.25) / 1.2: 1.23 times the relief by default.
/// Ridges lie about `feature` metres apart; octaves halve that length down to two spacings. With
/// the defaults, slopes are distributed as in the Swiss Alps at that spacing (rms 31 degrees).
/// Source: [Ebert et al. 2003, chapter 16], with a gain and a warp of our own.
RowFiller alpine(const GeneratorValues& values, const GridShape& shape);

}  // namespace plumb::terrain
