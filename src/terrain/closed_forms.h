// Terrains whose heights a reader can compute by hand.
#pragma once

#include "terrain/generator_parameters.h"

namespace plumb::terrain {

/// The formulas stand in terrain/generators.h.
RowFiller plane(const GeneratorValues& values, const GridShape& shape);
RowFiller tilted_plane(const GeneratorValues& values, const GridShape& shape);
RowFiller paraboloid(const GeneratorValues& values, const GridShape& shape);
RowFiller step(const GeneratorValues& values, const GridShape& shape);
RowFiller spike(const GeneratorValues& values, const GridShape& shape);
RowFiller sinusoid(const GeneratorValues& values, const GridShape& shape);
RowFiller checkerboard(const GeneratorValues& values, const GridShape& shape);

}  // namespace plumb::terrain
