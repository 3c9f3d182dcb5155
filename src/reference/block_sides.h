// On which sides of a ray the samples of a block of cells lie.
#pragma once

#include <cstdint>

#include "core/instruction_set.h"

namespace plumb::reference {

/// The samples of 4 x 4 cells, relative to a ray's origin: sample (a, b) stands at b * kRow + a.
/// A void, or a sample beyond the terrain's border, has NaN for its height.
struct BlockSamples {
  static constexpr int kRow = 5;
  static constexpr int kPadded = 32;  // 25, and up to a whole number of vectors

  alignas(64) double axis[3][kPadded];  // x, y, z
};

/// Coordinates across the ray, as RayFrame::place gives them, and bit k of `left` set where
/// u[k] <= 0, of `right` where u[k] >= 0, of `below` and `above` likewise for v.
struct BlockSides {
  alignas(64) double u[BlockSamples::kPadded], v[BlockSamples::kPadded];
  std::uint32_t left, right, below, above;
};

/// Which axis of the samples is which, and the ray's shears.
struct BlockView {
  const double* along;
  const double* across;
  const double* up;
  double shear_u, shear_v;
};

/// The same bits with every instruction set.
using FindBlockSides = void (*)(const BlockView&, BlockSides&);

FindBlockSides block_sides(InstructionSet set);

}  // namespace plumb::reference
