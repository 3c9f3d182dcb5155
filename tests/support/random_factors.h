// Tessellation factors of every kind that the rules tell apart.
#pragma once

#include <limits>

#include "mesh/tessellation/tessellator.h"
#include "support/random_scene.h"

namespace plumb::test_support {

/// Whole numbers, fractions, a little above whole numbers, below one, above 64; with `culling` also
/// zero, negative, infinite and NaN.
inline float random_factor(Random& random, bool culling) {
  const auto whole = static_cast<float>(random.integer(1, 64));
  switch (random.integer(0, culling ? 10 : 7)) {
    case 0:
    case 1:
      return whole;
    case 2:
    case 3:
      return static_cast<float>(random.uniform(1.0, 64.0));
    case 4:
      return static_cast<float>(random.uniform(1.0, 5.0));
    case 5:
      return whole * (1.0f + 1e-5f);
    case 6:
      return static_cast<float>(1.0 + random.integer(0, 12) * 0x1p-18);
    case 7:
      return static_cast<float>(random.chance(0.5) ? random.uniform(0.01, 1.0)
                                                   : random.uniform(64.0, 90.0));
    case 8:
      return random.chance(0.5) ? 1e-30f : 1e30f;
    case 9:
      return std::numeric_limits<float>::infinity();
    default:
      return random.chance(0.8)   ? whole
             : random.chance(0.5) ? std::numeric_limits<float>::quiet_NaN()
             : random.chance(0.5) ? 0.0f
                                  : -whole;
  }
}

/// Six factors of their own, or one for all.
inline mesh::tessellation::Factors random_factors(Random& random, bool culling) {
  mesh::tessellation::Factors factors{};
  for (float& factor : factors.outer) factor = random_factor(random, culling);
  for (float& factor : factors.inner) factor = random_factor(random, culling);
  if (random.chance(0.15)) {
    factors.outer.fill(factors.inner[0]);
    factors.inner[1] = factors.inner[0];
  }
  return factors;
}

}  // namespace plumb::test_support
