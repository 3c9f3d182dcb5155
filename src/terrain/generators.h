// Terrains made by a formula: the same bits for the same argument, on every machine.
#pragma once

#include <string>
#include <vector>

#include "terrain/heightfield.h"

namespace plumb::terrain {

struct GeneratorParameter {
  std::string name;
  std::string default_value;
  std::string meaning;  // with its unit and range
};

struct GeneratorHelp {
  std::string name;
  std::string meaning;
  std::vector<GeneratorParameter> parameters;  // those of all generators first
  bool makes_stacks = false;                   // and a heightfield only with surface=top
};

/// Every generator and every parameter that it takes, in the order in which help lists them.
const std::vector<GeneratorHelp>& generator_help();

/// True if `argument` names a generator ("generate:...") and not a file.
bool is_generator(const std::string& argument);

/// The terrain of `generate:NAME?key=value&key=value`, or `generate:NAME` for all defaults. With i
/// and j the sample's column and row (from the south-west), x = i * dx, y = j * dy in metres from
/// the south-west sample, `height` and `relief` in metres:
///
///   plane         height
///   tilted-plane  height + x * slope_x + y * slope_y
///   paraboloid    height + relief * (1 - (u^2 + v^2) / 2), u and v running from -1 to 1 across the
///                 terrain (0 where it is one sample wide): corners at height, centre relief above
///   step          height up to the column (row) floor((columns - 1) * position), height + relief
///                 beyond it
///   spike         height, but height + relief at one sample
///   sinusoid      height + relief / 2 * sin(2 pi x / wavelength_x) * sin(2 pi y / wavelength_y)
///   checkerboard  height + relief where floor(i / tile) + floor(j / tile) is odd, else height
///   alpine        ridged multifractal: terrain/alpine.h
///   dunes         crests across the wind with slip faces: terrain/dunes.h
///   canyon        a gorge with terraced walls: terrain/canyon.h
///   urban         blocks of buildings: terrain/urban.h
///   caves         with surface=top the top surface of what terrain/stacks/caves.h makes; without
///   it
///                 an error, as that is a terrain of stacks: terrain/stacks/stack_source.h
///
///   (1) Heights do not depend on the origin. Those of alpine, dunes, urban, caves, plane,
///   tilted-plane
///       (without relief), sinusoid and checkerboard do not depend on the size either: a smaller
///       terrain is the south-west corner of a larger one (its voids need not be).
///   (2) provenance.source names every parameter with its value, and gives the same terrain again.
/// Throws InputError that lists the known generators or parameters for an unknown one, that says
/// what was expected for a value that is out of range, and if the memory does not suffice.
Heightfield generate(const std::string& argument);

}  // namespace plumb::terrain
