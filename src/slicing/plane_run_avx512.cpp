#include "core/lanes_avx512.h"
#include "slicing/plane_run_kernel.h"

namespace plumb::slicing {

PlaneRunEnd meet_planes_avx512(const PlaneRun& run, const PlaneRunHeights& heights) {
  return meet_planes_of<Avx512Lanes>(run, heights);
}

}  // namespace plumb::slicing
