#include "scene.h"
#include "stage.h"
#include "terrain/stacks/stack_pyramid.h"
#include "terrain/stacks/stack_source.h"
#include "terrain/statistics.h"
#include "terrain/void_fill.h"

namespace plumb::determinism {
namespace {

std::uint64_t generators() {
  Checksum sum;
  for (const terrain::GeneratorHelp& generator : terrain::generator_help()) {
    for (const char* parameters : {"?size=33x21&spacing=20,15", "?size=25&seed=9&voids=0.1&utm=1"})
      sum.add(terrain::checksum(terrain::generate("generate:" + generator.name + parameters +
                                                  (generator.makes_stacks ? "&surface=top" : ""))));
  }
  return sum.value();
}

std::uint64_t stacks() {
  Checksum sum;
  for (const char* parameters : {"?size=65x43&spacing=4", "?size=40&seed=9&voids=0.1&utm=1"}) {
    const auto made = terrain::generate_stacks(std::string("generate:caves") + parameters);
    for (const terrain::StackField& level : terrain::stack_pyramid(made, 4))
      sum.add(terrain::checksum(level));
  }
  return sum.value();
}

std::uint64_t filled_voids() {
  terrain::Heightfield field = terrain::generate("generate:alpine?size=129&voids=0.3&seed=3");
  terrain::fill_voids(field);
  return terrain::checksum(field);
}

std::uint64_t statistics() {
  const terrain::TerrainStatistics found = terrain::statistics_of(hills());
  Checksum sum;
  sum.add(found.mean_m).add(found.rms_slope_deg).add(found.largest_slope_deg);
  sum.add(found.voids).add(found.lowest.height_m).add(found.highest.height_m);
  sum.add(found.steepest_step.rise_m).add(found.steepest_step.slope_deg);
  for (const std::int64_t count : found.slope_histogram) sum.add(count);
  return sum.value();
}

std::uint64_t presets() {
  const terrain::Heightfield field = hills();
  Checksum sum;
  for (const terrain::PresetHelp& preset : terrain::preset_help()) {
    const LookAt view = terrain::preset_camera(field, preset.name, 160, 90, 50.0);
    add(sum, view.eye_m);
    add(sum, view.target_m);
    add(sum, view.up);
    sum.add(view.near_m);
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> terrain_stages() {
  return {{"terrain.generators", generators},
          {"terrain.stacks", stacks},
          {"terrain.filled_voids", filled_voids},
          {"terrain.statistics", statistics},
          {"terrain.presets", presets}};
}

}  // namespace plumb::determinism
