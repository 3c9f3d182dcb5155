#include "core/lanes_avx2.h"
#include "reference/lane_walk_kernel.h"

namespace plumb::reference {

void walk_lanes_avx2(const LaneScene& scene, LaneRays& rays) {
  walk_in_lanes<Avx2Lanes>(scene, rays);
}

}  // namespace plumb::reference
