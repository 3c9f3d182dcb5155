#include "mesh/full/full_detail.h"
#include "raster/rasteriser.h"
#include "raster/shading/preview.h"
#include "raster/shading/shade.h"
#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

// The oblique view, and one that stands on the ground and cuts triangles at its near plane.
std::uint64_t pictures() {
  const terrain::Heightfield field = hills();
  const DrawnSurface surface = mesh::full::prepare(field).surface;
  Checksum sum;
  for (const char* preset : {"oblique", "grazing"}) {
    const Camera camera = camera_for(field, preset);
    for (const int tile_px : {16, 64}) {
      raster::RasterOptions options;
      options.tile_px = tile_px;
      const raster::RasterResult result = raster::rasterise(*surface.mesh, camera, options);
      add(sum, result.image);
      sum.add(result.fragments);
    }
  }
  return sum.value();
}

void add_colours(Checksum& sum, const image::ColourImage& picture) {
  for (const auto* channel : {&picture.r, &picture.g, &picture.b})
    sum.add(std::span<const float>(*channel));
}

std::uint64_t shading() {
  const terrain::Heightfield field = hills();
  const DrawnSurface surface = mesh::full::prepare(field).surface;
  const Camera camera = camera_for(field, "oblique");
  const HitImage hits = raster::rasterise(*surface.mesh, camera).image;
  raster::ShadeOptions options;
  options.low_m = 300.0;
  options.high_m = 2800.0;
  options.haze_m = 5000.0;
  Checksum sum;
  add_colours(sum, raster::shade(hits, camera, raster::flat_normals(*surface.mesh, hits), options));
  add_colours(sum, raster::shaded_preview(field, 50));
  return sum.value();
}

}  // namespace

std::vector<Stage> raster_stages() {
  return {{"raster.pictures", pictures}, {"raster.shading", shading}};
}

}  // namespace plumb::determinism
