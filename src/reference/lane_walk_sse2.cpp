#include "core/lanes_sse2.h"
#include "reference/lane_walk_kernel.h"

namespace plumb::reference {

void walk_lanes_sse2(const LaneScene& scene, LaneRays& rays) {
  walk_in_lanes<Sse2Lanes>(scene, rays);
}

}  // namespace plumb::reference
