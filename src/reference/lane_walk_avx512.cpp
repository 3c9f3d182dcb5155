#include "core/lanes_avx512.h"
#include "reference/lane_walk_kernel.h"

namespace plumb::reference {

void walk_lanes_avx512(const LaneScene& scene, LaneRays& rays) {
  walk_in_lanes<Avx512Lanes>(scene, rays);
}

}  // namespace plumb::reference
