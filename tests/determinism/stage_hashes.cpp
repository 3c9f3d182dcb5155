// Prints one line a stage: its name and the checksum of its bits. `stage_hashes [THREADS]`.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/parallel.h"
#include "stage.h"

int main(int argc, char** argv) {
  using namespace plumb::determinism;
  const plumb::ThreadLimit limit(argc > 1 ? std::atoi(argv[1]) : 0);
  std::vector<Stage> stages;
  for (const auto& module : {core_stages(), terrain_stages(), raster_stages(), reference_stages(),
                             report_stages(), mesh_stages(), contouring_stages(), stack_stages(),
                             slicing_stages(), audit_stages(), compare_stages()})
    stages.insert(stages.end(), module.begin(), module.end());
  for (const Stage& stage : stages)
    std::printf("%-32s %016llx\n", stage.name, static_cast<unsigned long long>(stage.run()));
  return stages.empty() ? 1 : 0;
}
