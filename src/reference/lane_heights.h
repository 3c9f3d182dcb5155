// Heights and ranges of heights for the lanes of lane_walk_kernel.h, from floats or from codes of
// 16 bits: the same doubles. Included as that is.
#pragma once

#include "reference/lane_walk.h"

namespace plumb::reference {
namespace {

template <class L>
class LaneFloats {
  using Real = typename L::Real;
  using Mask = typename L::Mask;
  using Pair = typename L::Pair;

 public:
  explicit LaneFloats(const LaneScene& scene)
      : ranges_(scene.ranges),
        south_(scene.heights),
        north_(scene.heights + static_cast<std::int64_t>(scene.columns)) {}

  /// Heights of the samples `index` and index + 1; NaN for a void.
  PLUMB_INLINE Pair south(Real index, Mask m) const {
    return L::template gather<1>(south_, index, m);
  }
  /// Of those one row to the north.
  PLUMB_INLINE Pair north(Real index, Mask m) const {
    return L::template gather<1>(north_, index, m);
  }
  /// Least and greatest height of node `index`; +inf and -inf where all is void.
  PLUMB_INLINE Pair range(Real index, Mask m) const {
    return L::template gather<2>(ranges_, index, m);
  }

 private:
  const float *ranges_, *south_, *north_;
};

template <class L>
class LaneCodes {
  using Real = typename L::Real;
  using Mask = typename L::Mask;
  using Pair = typename L::Pair;

 public:
  explicit LaneCodes(const LaneScene& scene)
      : ranges_(scene.range_codes),
        south_(scene.height_codes),
        north_(scene.height_codes + static_cast<std::int64_t>(scene.columns)),
        first_(scene.code_first),
        is_whole_(scene.code_scale == 1.0 && scene.code_offset == 0.0),
        is_plain_(is_whole_ && scene.void_code > 65535),
        scale_(L::all(scene.code_scale)),
        offset_(L::all(scene.code_offset)),
        void_(L::all(scene.code_first + scene.void_code)) {}

  PLUMB_INLINE Pair south(Real index, Mask m) const { return samples(south_, index, m); }
  PLUMB_INLINE Pair north(Real index, Mask m) const { return samples(north_, index, m); }
  PLUMB_INLINE Pair range(Real index, Mask m) const {
    const Pair stored = L::template gather<2>(ranges_, index, m, first_);
    return heights(stored, __builtin_inf(), -__builtin_inf());
  }

 private:
  PLUMB_INLINE Pair samples(const std::uint16_t* codes, Real index, Mask m) const {
    const Pair stored = L::template gather<1>(codes, index, m, first_);
    return heights(stored, __builtin_nan(""), __builtin_nan(""));
  }
  PLUMB_INLINE Pair heights(const Pair& stored, double first_void, double second_void) const {
    if (is_plain_) return stored;
    return {height(stored.first, first_void), height(stored.second, second_void)};
  }
  // As terrain::HeightCoding has it; a whole number of 17 bits is its own float.
  PLUMB_INLINE Real height(Real stored, double of_void) const {
    const Real height = is_whole_ ? stored : L::to_float(stored * scale_ + offset_);
    return L::choose(L::equal(stored, void_), L::all(of_void), height);
  }

  const std::uint16_t *ranges_, *south_, *north_;
  int first_;
  bool is_whole_;  // heights are what is stored
  bool is_plain_;  // and no void is
  Real scale_, offset_, void_;
};

}  // namespace
}  // namespace plumb::reference
