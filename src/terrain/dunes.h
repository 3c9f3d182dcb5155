// Sand dunes.
#pragma once

#include "terrain/generator_parameters.h"

namespace plumb::terrain {

/// Transverse dunes, barchanoid where they are low: crests about `wavelength` apart, across the
/// wind, bent and broken by noise; low parts run ahead downwind, as they do in nature.
///
/// Windward an S-shaped rise whose mean slope is 10 degrees; leeward sand at its angle of repose,
/// 32 degrees: the upper envelope of cones of that slope whose tips are the crest (a polyline of 32
/// knots a wavelength, heights linear along it). A terrain is the highest of its dunes, and level
/// at `height` between them.
///
///   (1) Heights lie in [height, height + relief]; the tallest crests are `relief` high.
///   (2) Two samples differ by at most tan(32 degrees) times their distance, before rounding: slip
///       faces by their construction, windward sides because relief and bend are limited (the
///       limits are measured ones: the steepest of 60 seeds at both limits kept within it).
/// Source: our own construction; the two angles are those of textbook dunes.
RowFiller dunes(const GeneratorValues& values, const GridShape& shape);

}  // namespace plumb::terrain
