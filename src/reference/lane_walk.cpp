#include "reference/lane_walk.h"

namespace plumb::reference {

void walk_lanes_sse2(const LaneScene& scene, LaneRays& rays);
void walk_lanes_avx2(const LaneScene& scene, LaneRays& rays);
void walk_lanes_avx512(const LaneScene& scene, LaneRays& rays);

LaneWalk lane_walk(InstructionSet set) {
  switch (set) {
    case InstructionSet::Sse2:
      return walk_lanes_sse2;
    case InstructionSet::Avx2:
      return walk_lanes_avx2;
    case InstructionSet::Avx512:
      return walk_lanes_avx512;
  }
  return walk_lanes_sse2;
}

}  // namespace plumb::reference
