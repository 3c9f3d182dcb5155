#include <span>

#include "slicing/slicing_method.h"

#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t frames(const slicing::Parameters& parameters) {
  const terrain::Heightfield field = hills();
  const slicing::Prepared prepared =
      slicing::prepare(field, terrain::Diagonal::Alternating, parameters);
  Checksum sum;
  for (const char* preset : {"oblique", "grazing"}) {
    const Camera camera = camera_for(field, preset);
    const DrawnSurface surface = slicing::draw(prepared, camera, {1.0, Unit::Pixel});
    for (const Patch& patch : surface.patches) sum.add(patch.lod).add(std::string_view(patch.name));
    sum.add(surface.cost.slices);
    add(sum, surface.cost);
    const SurfacePicture picture = surface.painter(camera);
    sum.add(picture.fragments);
    add(sum, picture.image);
    sum.add(std::span<const float>(picture.layers.behind));
    for (const Layer& layer : picture.layers.layers) {
      sum.add(layer.weight);
      for (int k = 0; k < 3; ++k) sum.add(layer.from_eye_m[k]);
    }
  }
  return sum.value();
}

std::uint64_t conservative() { return frames({}); }

std::uint64_t published() {
  slicing::Parameters parameters;
  parameters.cut.variant = slicing::Variant::Published;
  parameters.cut.hybrid = false;
  parameters.renderer = slicing::SliceRenderer::Quads;
  return frames(parameters);
}

std::uint64_t looked_up(slicing::Interpolation heights) {
  slicing::Parameters parameters;
  parameters.cut.variant = slicing::Variant::Published;
  parameters.choice = slicing::CutChoice::Optimum;
  parameters.heights = heights;
  return frames(parameters);
}

std::uint64_t blended() {
  slicing::Parameters parameters;
  parameters.blend.falloff_px = 2.0;
  parameters.blend.fog_per_m = 1e-3;
  return frames(parameters);
}

}  // namespace

std::vector<Stage> slicing_stages() {
  return {{"slicing.conservative", conservative},
          {"slicing.published", published},
          {"slicing.blended", blended},
          {"slicing.eight_bit", [] { return looked_up(slicing::Interpolation::EightBit); }},
          {"slicing.mip_mapped", [] { return looked_up(slicing::Interpolation::MipMapped); }}};
}

}  // namespace plumb::determinism
