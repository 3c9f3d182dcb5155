// A plateau with a gorge cut into it.
#pragma once

#include "terrain/generator_parameters.h"

namespace plumb::terrain {

/// A meandering river from west to east through the middle of the terrain, `width` metres from rim
/// to rim, with tributaries and theirs, which climb towards the plateau. Walls are terraced:
/// `strata` layers of rock, each as high everywhere as anywhere else, a slope of debris under a
/// cliff.
///
/// How far a sample lies up the walls is a number from 0 (river) to 1 (rim), the least of what the
/// distances to the channels nearby make of it, with the coordinates bent by noise; the layers turn
/// it into a height.
///
///   (1) Heights lie in [height, height + relief]: the floor is level at the one, the plateau at
///       the other.
///   (2) Of each layer's rise 45 to 90 % is cliff, within 5 % of the layer's width: less than a
///       cell of the default terrain, on which walls are 80 degrees steep and more.
/// Source: our own.
RowFiller canyon(const GeneratorValues& values, const GridShape& shape);

}  // namespace plumb::terrain
