#include "audit/surface_picture.h"

#include "core/check.h"
#include "core/parallel.h"
#include "raster/rasteriser.h"
#include "raster/shading/shade.h"
#include "reference/surface_height.h"

namespace plumb::audit {

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
    const glm::dvec3 point = eye + drawn.from_eye_m[pixel];
    const std::uint32_t triangle =
        reference::surface_at(field, diagonal, point.x, point.y).triangle;
    normals[pixel] = triangle != kNoPrimitive
                         ? reference::triangle_normal(field, diagonal, triangle)
                         : glm::dvec3(0.0, 0.0, 1.0);
  });
  return normals;
}

}  // namespace plumb::audit
