#include "reference/embree_caster.h"
#include "reference/heightfield_nearest.h"
#include "reference/pyramid_caster.h"
#include "reference/surface_height.h"
#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t pyramid_frames() {
  const terrain::Heightfield field = hills();
  Checksum sum;
  for (const auto diagonal : {terrain::Diagonal::Alternating, terrain::Diagonal::Blocks8}) {
    const reference::PyramidCaster caster(field, diagonal);
    for (const char* preset : {"oblique", "grazing"})
      add(sum, caster.cast_frame(camera_for(field, preset)));
  }
  return sum.value();
}

// Whatever Embree proposes on this processor, what is decided in double is the same.
std::uint64_t embree_frames() {
  const terrain::Heightfield field = hills();
  Checksum sum;
  for (const char* instruction_set : {"", "sse2"}) {
    reference::EmbreeOptions options;
    options.instruction_set = instruction_set;
    const reference::EmbreeCaster caster(field, terrain::Diagonal::Alternating, options);
    for (const char* preset : {"oblique", "grazing"})
      add(sum, caster.cast_frame(camera_for(field, preset)));
  }
  return sum.value();
}

std::uint64_t points_above_and_nearest() {
  const terrain::Heightfield field = hills();
  const reference::PyramidCaster caster(field, terrain::Diagonal::Fixed);
  Sequence numbers(6);
  Checksum sum;
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 point{numbers.between(-100.0, 1900.0), numbers.between(-100.0, 2150.0),
                           numbers.between(300.0, 2800.0)};
    const auto above = reference::surface_at(field, caster.diagonal(), point.x, point.y);
    sum.add(above.height_m).add(above.triangle);
    const auto nearest =
        reference::nearest_on_heightfield(field, caster.diagonal(), caster.pyramid(), point, 400.0);
    add(sum, nearest.point_m);
    sum.add(nearest.distance_m).add(nearest.triangle);
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> reference_stages() {
  return {{"reference.pyramid_frames", pyramid_frames},
          {"reference.embree_frames", embree_frames},
          {"reference.nearest_points", points_above_and_nearest}};
}

}  // namespace plumb::determinism
