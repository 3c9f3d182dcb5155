#include "audit/project_samples.h"

#include "core/screen_error.h"

namespace plumb::audit {

void project_samples_sse2(const ProjectingCamera& camera, const SampleRun& run,
                          ProjectedSamples& to, double& pixels_per_metre);
void project_samples_avx2(const ProjectingCamera& camera, const SampleRun& run,
                          ProjectedSamples& to, double& pixels_per_metre);
void project_samples_avx512(const ProjectingCamera& camera, const SampleRun& run,
                            ProjectedSamples& to, double& pixels_per_metre);

ProjectingCamera::ProjectingCamera(const Camera& local)
    : camera(local), up(direction_to_view(local, {0.0, 0.0, 1.0})) {}

ProjectSamples project_samples(InstructionSet set) {
  return kernel_for(set, project_samples_sse2, project_samples_avx2, project_samples_avx512);
}

}  // namespace plumb::audit
