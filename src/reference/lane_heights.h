// Heights and ranges of heights for the lanes of lane_walk_kernel.h. Included as that is.
#pragma once

#include "reference/lane_walk.h"
#include "terrain/lane_heights.h"

namespace plumb::reference {
namespace {

template <class L>
class WalkFloats : public terrain::LaneFloats<L> {
 public:
  explicit WalkFloats(const LaneScene& scene)
      : terrain::LaneFloats<L>(scene.heights), ranges_(scene.ranges) {}

  /// Least and greatest height of node `index`; +inf and -inf where all is void.
  PLUMB_INLINE typename L::Pair range(typename L::Real index, typename L::Mask m) const {
    return L::template gather<2>(ranges_, index, m);
  }

 private:
  const float* ranges_;
};

template <class L>
class WalkCodes : public terrain::LaneCodes<L> {
 public:
  explicit WalkCodes(const LaneScene& scene)
      : terrain::LaneCodes<L>(scene.heights), ranges_(scene.range_codes) {}

  PLUMB_INLINE typename L::Pair range(typename L::Real index, typename L::Mask m) const {
    return this->pairs(ranges_, index, m, __builtin_inf(), -__builtin_inf());
  }

 private:
  const std::uint16_t* ranges_;
};

}  // namespace
}  // namespace plumb::reference
