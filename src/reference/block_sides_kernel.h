// Written once for every number of lanes; see lane_walk_kernel.h for who may include it.
#pragma once

#include "reference/block_sides.h"

namespace plumb::reference {
namespace {

template <class L>
void find_block_sides(const BlockView& view, BlockSides& sides) {
  using Real = typename L::Real;
  const Real shear_u = L::all(view.shear_u), shear_v = L::all(view.shear_v), zero = L::all(0.0);
  sides.left = sides.right = sides.below = sides.above = 0;
  for (int k = 0; k < BlockSamples::kPadded; k += L::kCount) {
    const Real depth = L::load(view.along + k);
    const Real u = L::load(view.across + k) - shear_u * depth;
    const Real v = L::load(view.up + k) - shear_v * depth;
    L::store(sides.u + k, u);
    L::store(sides.v + k, v);
    sides.left |= L::bits(L::less_equal(u, zero)) << k;
    sides.right |= L::bits(L::less_equal(zero, u)) << k;
    sides.below |= L::bits(L::less_equal(v, zero)) << k;
    sides.above |= L::bits(L::less_equal(zero, v)) << k;
  }
}

}  // namespace
}  // namespace plumb::reference
