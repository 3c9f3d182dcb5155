#include "slicing/plane_run.h"

namespace plumb::slicing {

PlaneRunEnd meet_planes_sse2(const PlaneRun& run, const PlaneRunHeights& heights);
PlaneRunEnd meet_planes_avx2(const PlaneRun& run, const PlaneRunHeights& heights);
PlaneRunEnd meet_planes_avx512(const PlaneRun& run, const PlaneRunHeights& heights);

MeetPlanes meet_planes(InstructionSet set) {
  return kernel_for(set, meet_planes_sse2, meet_planes_avx2, meet_planes_avx512);
}

}  // namespace plumb::slicing
