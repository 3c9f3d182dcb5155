#include "mesh/full/full_detail.h"
#include "reference/embree_caster.h"
#include "reference/pyramid_caster.h"
#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t rays() {
  const terrain::Heightfield field = mountains();
  Checksum sum;
  for (const terrain::Diagonal diagonal :
       {terrain::Diagonal::Alternating, terrain::Diagonal::Fixed, terrain::Diagonal::Blocks8}) {
    const reference::PyramidCaster caster(field, diagonal);
    for (const char* preset : {"oblique", "grazing", "valley", "top"})
      add(sum, caster.cast_frame(view_of(field, preset)));
  }
  return sum.value();
}

// As terrain and as mesh, on the processor's best instruction set and on its oldest.
std::uint64_t embree_rays() {
  const terrain::Heightfield field = mountains();
  const DrawnSurface surface = mesh::full::prepare(field).surface;
  Checksum sum;
  for (const char* instruction_set : {"", "sse2"}) {
    const reference::EmbreeOptions options{instruction_set};
    const reference::EmbreeCaster of_terrain(field, terrain::Diagonal::Alternating, options);
    const reference::EmbreeCaster of_mesh(*surface.mesh, options);
    for (const char* preset : {"oblique", "valley"}) {
      add(sum, of_terrain.cast_frame(view_of(field, preset)));
      add(sum, of_mesh.cast_frame(view_of(field, preset)));
    }
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> reference_stages() {
  return {{"reference.pyramid_rays", rays}, {"reference.embree_rays", embree_rays}};
}

}  // namespace plumb::determinism
