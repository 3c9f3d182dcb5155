#include "audit/project_samples_kernel.h"
#include "core/lanes_avx2.h"

namespace plumb::audit {

void project_samples_avx2(const ProjectingCamera& camera, const SampleRun& run,
                          ProjectedSamples& to, double& pixels_per_metre) {
  project_samples_of<Avx2Lanes>(camera, run, to, pixels_per_metre);
}

}  // namespace plumb::audit
