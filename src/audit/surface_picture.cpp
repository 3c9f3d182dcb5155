#include "audit/surface_picture.h"

#include "core/check.h"
#include "core/parallel.h"
#include "raster/rasteriser.h"
#include "raster/shading/shade.h"
#include "reference/surface_height.h"

namespace plumb::audit {
namespace {

// Of the terrain above or below a point, which is relative to its origin.
glm::dvec3 ground_normal(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                         const glm::dvec3& point_m) {
  const std::uint32_t triangle =
      reference::surface_at(field, diagonal, point_m.x, point_m.y).triangle;
  return triangle != kNoPrimitive ? reference::triangle_normal(field, diagonal, triangle)
                                  : glm::dvec3(0.0, 0.0, 1.0);
}

}  // namespace

SurfacePicture picture_of(const DrawnSurface& surface, const Camera& camera) {
  require(surface.mesh != nullptr || surface.painter, "a drawn surface needs a mesh or a painter");
  if (surface.mesh == nullptr) return surface.painter(camera);
  raster::RasterResult raster =
      raster::rasterise(*surface.mesh, camera, {.runs = surface.usable_runs()});
  return {std::move(raster.image), raster.fragments};
}

std::vector<glm::dvec3> shading_normals(const DrawnSurface& surface, const HitImage& drawn,
                                        const Camera& camera, const terrain::Heightfield& field,
                                        terrain::Diagonal diagonal) {
  require(surface.mesh != nullptr || surface.painter, "a drawn surface needs a mesh or a painter");
  if (surface.mesh != nullptr) return raster::flat_normals(*surface.mesh, drawn);
  std::vector<glm::dvec3> normals(drawn.size(), glm::dvec3(0.0));
  const glm::dvec3 eye = camera.eye_m - field.world_origin_m();
  parallel_for(static_cast<std::int64_t>(drawn.size()), 4096, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (!drawn.hit(pixel)) return;
    normals[pixel] = ground_normal(field, diagonal, eye + drawn.from_eye_m[pixel]);
  });
  return normals;
}

std::vector<glm::dvec3> layer_normals(const Layers& layers, const Camera& camera,
                                      const terrain::Heightfield& field,
                                      terrain::Diagonal diagonal) {
  std::vector<glm::dvec3> normals(layers.layers.size());
  const glm::dvec3 eye = camera.eye_m - field.world_origin_m();
  parallel_for(static_cast<std::int64_t>(normals.size()), 4096, [&](std::int64_t k) {
    const auto at = static_cast<std::size_t>(k);
    normals[at] = ground_normal(field, diagonal, eye + layers.layers[at].from_eye_m);
  });
  return normals;
}

}  // namespace plumb::audit
