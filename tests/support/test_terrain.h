// Small terrains for tests: rough ones from integers alone, with voids where asked.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "audit/stability/rough_ground.h"
#include "terrain/generators.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

using audit::stability::noise;
using audit::stability::rough_height;

inline terrain::Heightfield rough_terrain(int columns, int rows, std::uint32_t seed,
                                          double relief_m = 100.0, double void_share = 0.0,
                                          double dx_m = 10.0, double dy_m = 10.0) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(columns, rows);
  field.dx_m = dx_m;
  field.dy_m = dy_m;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      field.heights_m.floats()(i, j) = static_cast<float>(rough_height(seed, i, j, relief_m));
      // Voids come in clumps and alone.
      const bool is_void = noise(seed + 1000, i / 3, j / 3) < void_share ||
                           noise(seed + 2000, i, j) < void_share / 8;
      if (is_void) field.heights_m.floats()(i, j) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return field;
}

/// The heights of a generator: with `query`, which asks for the top surface of what makes stacks.
inline std::string heights_of(const terrain::GeneratorHelp& help, const std::string& query) {
  return "generate:" + help.name + "?" + query + (help.makes_stacks ? "&surface=top" : "");
}

}  // namespace plumb::test_support
