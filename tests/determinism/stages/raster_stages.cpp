#include "image/srgb.h"
#include "mesh/full/full_detail.h"
#include "raster/rasteriser.h"
#include "raster/shading/preview.h"
#include "raster/shading/shade.h"
#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t pictures() {
  const terrain::Heightfield field = mountains();
  const auto surface = mesh::full::prepare(field).surface;
  const TriangleMesh& mesh = *surface.mesh;
  Checksum sum;
  for (const char* preset : {"oblique", "grazing"}) {
    const raster::RasterResult result = raster::rasterise(mesh, view_of(field, preset));
    add(sum, result.image);
    sum.add(result.fragments);
  }
  return sum.value();
}

void add(Checksum& sum, const image::ColourImage& image) {
  sum.add(std::span<const float>(image.r)).add(std::span<const float>(image.g));
  sum.add(std::span<const float>(image.b));
  sum.add(std::span<const std::uint8_t>(image::to_srgb8(image).rgb));
}

std::uint64_t shading() {
  const terrain::Heightfield field = mountains();
  const auto surface = mesh::full::prepare(field).surface;
  const TriangleMesh& mesh = *surface.mesh;
  const Camera camera = view_of(field, "valley");
  const HitImage hits = raster::rasterise(mesh, camera).image;
  raster::ShadeOptions options;
  options.high_m = 3000.0;
  Checksum sum;
  add(sum, raster::shade(hits, camera, raster::flat_normals(mesh, hits), options));
  add(sum, raster::shaded_preview(field, 100));
  return sum.value();
}

}  // namespace

std::vector<Stage> raster_stages() {
  return {{"raster.pictures", pictures}, {"raster.shading", shading}};
}

}  // namespace plumb::determinism
