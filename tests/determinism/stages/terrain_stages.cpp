#include "scene.h"
#include "stage.h"
#include "terrain/statistics.h"

namespace plumb::determinism {
namespace {

std::uint64_t generators() {
  Checksum sum;
  for (const terrain::GeneratorHelp& generator : terrain::generator_help())
    sum.add(terrain::checksum(terrain::generate("generate:" + generator.name + "?size=65")));
  return sum.value();
}

std::uint64_t statistics() {
  const terrain::TerrainStatistics found = terrain::statistics_of(mountains());
  Checksum sum;
  sum.add(found.voids).add(found.mean_m).add(found.rms_slope_deg).add(found.largest_slope_deg);
  sum.add(found.lowest.height_m).add(found.highest.height_m).add(found.steepest_step.rise_m);
  return sum.add(std::span<const std::int64_t>(found.slope_histogram)).value();
}

std::uint64_t presets() {
  const terrain::Heightfield field = mountains();
  Checksum sum;
  for (const terrain::PresetHelp& preset : terrain::preset_help()) {
    const LookAt camera = terrain::preset_camera(field, preset.name, 320, 180, 50.0);
    add(sum, camera.eye_m);
    add(sum, camera.target_m);
    add(sum, camera.up);
    sum.add(camera.near_m);
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> terrain_stages() {
  return {{"terrain.generators", generators},
          {"terrain.statistics", statistics},
          {"terrain.presets", presets}};
}

}  // namespace plumb::determinism
