#include "reference/lane_walk.h"

namespace plumb::reference {

void walk_lanes_sse2(const LaneScene& scene, LaneRays& rays);
void walk_lanes_avx2(const LaneScene& scene, LaneRays& rays);
void walk_lanes_avx512(const LaneScene& scene, LaneRays& rays);

LaneWalk lane_walk(InstructionSet set) {
  return kernel_for(set, walk_lanes_sse2, walk_lanes_avx2, walk_lanes_avx512);
}

}  // namespace plumb::reference
