#include "audit/project_samples_kernel.h"
#include "core/lanes_avx512.h"

namespace plumb::audit {

void project_samples_avx512(const ProjectingCamera& camera, const SampleRun& run,
                            ProjectedSamples& to, double& pixels_per_metre) {
  project_samples_of<Avx512Lanes>(camera, run, to, pixels_per_metre);
}

}  // namespace plumb::audit
