#include "core/lanes_avx2.h"
#include "slicing/plane_run_kernel.h"

namespace plumb::slicing {

PlaneRunEnd meet_planes_avx2(const PlaneRun& run, const PlaneRunHeights& heights) {
  return meet_planes_of<Avx2Lanes>(run, heights);
}

}  // namespace plumb::slicing
