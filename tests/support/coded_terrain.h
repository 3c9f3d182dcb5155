// Terrains whose heights are kept as codes of 16 bits, beside the same as floats.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/random_scene.h"

namespace plumb::test_support {

/// One terrain kept in two ways.
struct Twins {
  terrain::Heightfield coded, floats;
};

/// Whole metres from either first value, the classic 0.1 m, and heights that no float holds
/// exactly.
inline terrain::HeightCoding random_coding(Random& random) {
  terrain::HeightCoding coding;
  coding.first = random.chance(0.5) ? 0 : -32768;
  switch (random.integer(0, 3)) {
    case 0:
      break;
    case 1:
      coding.scale = 0.1;
      break;
    case 2:
      coding.scale = 0.3048;
      coding.offset_m = -1234.567;
      break;
    default:
      coding.scale = 1.0;
      coding.offset_m = random.integer(-500, 500);
      break;
  }
  return coding;
}

/// The nearest heights that codes have. A void's code is the least, the greatest or another one.
inline Twins coded_twins(Random& random, const terrain::Heightfield& field) {
  terrain::HeightCoding coding = random_coding(random);
  const int void_codes[] = {0, 65535, 40000};
  const int void_code = void_codes[random.integer(0, 2)];
  Grid<std::uint16_t> codes(field.columns(), field.rows());
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      if (field.is_void(i, j)) {
        coding.void_code = void_code;
        codes(i, j) = static_cast<std::uint16_t>(void_code);
        continue;
      }
      const double stored = (field.heights_m(i, j) - coding.offset_m) / coding.scale;
      int code = static_cast<int>(std::clamp(std::floor(stored) - coding.first, 0.0, 65535.0));
      if (code == void_code) code += code == 0 ? 1 : -1;
      codes(i, j) = static_cast<std::uint16_t>(code);
    }
  }
  Twins twins{field, field};
  twins.coded.heights_m = terrain::HeightGrid(std::move(codes), coding);
  twins.floats.heights_m = twins.coded.heights_m.to_floats();
  return twins;
}

}  // namespace plumb::test_support
