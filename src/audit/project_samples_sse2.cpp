#include "audit/project_samples_kernel.h"
#include "core/lanes_sse2.h"

namespace plumb::audit {

void project_samples_sse2(const ProjectingCamera& camera, const SampleRun& run,
                          ProjectedSamples& to, double& pixels_per_metre) {
  project_samples_of<Sse2Lanes>(camera, run, to, pixels_per_metre);
}

}  // namespace plumb::audit
