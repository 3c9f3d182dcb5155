// A town.
#pragma once

#include "terrain/generator_parameters.h"

namespace plumb::terrain {

/// Blocks of buildings between streets, on ground that slopes by a few percent. Blocks are lots
/// with a house each, closed rows around a court, a tower on a plinth, or parks; walls are vertical
/// (a step between two samples), roofs are level or, on low houses, pitched at 35 degrees.
/// Buildings grow higher in some quarters than in others.
///
///   (1) Heights lie in [height, height + relief]: `ground` metres of it are the ground's, the rest
///       is for buildings, of which the tallest towers use up most.
///   (2) A roof that is not pitched is level to the bit, whatever the ground does beneath.
/// Source: our own.
RowFiller urban(const GeneratorValues& values, const GridShape& shape);

}  // namespace plumb::terrain
