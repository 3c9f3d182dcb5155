// Samples for the lanes of core/lanes_*.h, from floats or from codes of 16 bits: the same doubles.
// Written once for every number of lanes; see reference/lane_walk_kernel.h for who may include it.
#pragma once

#include "terrain/stored_heights.h"

namespace plumb::terrain {
namespace {

/// Heights that are stored as floats.
template <class L>
class LaneFloats {
  using Real = typename L::Real;
  using Mask = typename L::Mask;
  using Pair = typename L::Pair;

 public:
  explicit LaneFloats(const StoredHeights& heights)
      : south_(heights.floats), north_(heights.floats + heights.columns) {}

  /// Heights of the samples `index` and index + 1; NaN for a void.
  __attribute__((always_inline)) inline Pair south(Real index, Mask m) const {
    return L::template gather<1>(south_, index, m);
  }
  /// Of those one row to the north.
  __attribute__((always_inline)) inline Pair north(Real index, Mask m) const {
    return L::template gather<1>(north_, index, m);
  }

 private:
  const float *south_, *north_;
};

/// Heights that are stored as codes.
template <class L>
class LaneCodes {
  using Real = typename L::Real;
  using Mask = typename L::Mask;
  using Pair = typename L::Pair;

 public:
  explicit LaneCodes(const StoredHeights& heights)
      : south_(heights.codes),
        north_(heights.codes + heights.columns),
        first_(heights.code_first),
        is_whole_(heights.code_scale == 1.0 && heights.code_offset == 0.0),
        is_plain_(is_whole_ && heights.void_code > 65535),
        scale_(L::all(heights.code_scale)),
        offset_(L::all(heights.code_offset)),
        void_(L::all(heights.code_first + heights.void_code)) {}

  __attribute__((always_inline)) inline Pair south(Real index, Mask m) const {
    return samples(south_, index, m);
  }
  __attribute__((always_inline)) inline Pair north(Real index, Mask m) const {
    return samples(north_, index, m);
  }
  /// Heights of the pairs of codes at 2 * index; what a void's code stands for is given.
  __attribute__((always_inline)) inline Pair pairs(const std::uint16_t* codes, Real index, Mask m,
                                                   double first_void, double second_void) const {
    return heights(L::template gather<2>(codes, index, m, first_), first_void, second_void);
  }

 private:
  __attribute__((always_inline)) inline Pair samples(const std::uint16_t* codes, Real index,
                                                     Mask m) const {
    const double nothing = __builtin_nan("");
    return heights(L::template gather<1>(codes, index, m, first_), nothing, nothing);
  }
  __attribute__((always_inline)) inline Pair heights(const Pair& stored, double first_void,
                                                     double second_void) const {
    if (is_plain_) return stored;
    return {height(stored.first, first_void), height(stored.second, second_void)};
  }
  // As HeightCoding has it; a whole number of 17 bits is its own float.
  __attribute__((always_inline)) inline Real height(Real stored, double of_void) const {
    const Real height = is_whole_ ? stored : L::to_float(stored * scale_ + offset_);
    return L::choose(L::equal(stored, void_), L::all(of_void), height);
  }

  const std::uint16_t *south_, *north_;
  int first_;
  bool is_whole_;  // heights are what is stored
  bool is_plain_;  // and no void is
  Real scale_, offset_, void_;
};

}  // namespace
}  // namespace plumb::terrain
