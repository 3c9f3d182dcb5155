#include "core/lanes_sse2.h"
#include "slicing/plane_run_kernel.h"

namespace plumb::slicing {

PlaneRunEnd meet_planes_sse2(const PlaneRun& run, const PlaneRunHeights& heights) {
  return meet_planes_of<Sse2Lanes>(run, heights);
}

}  // namespace plumb::slicing
