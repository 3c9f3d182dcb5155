#include <cmath>

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

// The same hills in feet as a file of 16 bits may have them.
std::uint64_t coded_pyramid_frames() {
  terrain::Heightfield field = hills();
  const terrain::HeightCoding coding{-32768, 0.3048, 12.5, 0};
  Grid<std::uint16_t> codes(field.columns(), field.rows(), 0);
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      if (field.is_void(i, j)) continue;
      const double stored = (field.heights_m(i, j) - coding.offset_m) / coding.scale;
      codes(i, j) = static_cast<std::uint16_t>(std::floor(stored) - coding.first);
    }
  }
  field.heights_m = terrain::HeightGrid(std::move(codes), coding);
  const reference::PyramidCaster caster(field, terrain::Diagonal::Alternating);
  Checksum sum;
  for (const char* preset : {"oblique", "grazing"})
    add(sum, caster.cast_frame(camera_for(field, preset)));
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
          {"reference.coded_pyramid_frames", coded_pyramid_frames},
          {"reference.embree_frames", embree_frames},
          {"reference.nearest_points", points_above_and_nearest}};
}

}  // namespace plumb::determinism
