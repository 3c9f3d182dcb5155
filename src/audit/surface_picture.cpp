#include "audit/surface_picture.h"

#include <glm/geometric.hpp>

#include <algorithm>

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

std::vector<glm::vec3> vertex_albedo(const DrawnSurface& surface, const HitImage& drawn,
                                     const Camera& camera) {
  if (surface.mesh == nullptr || surface.vertex_colours.empty()) return {};
  const TriangleMesh& mesh = *surface.mesh;
  require(surface.vertex_colours.size() == mesh.vertices_m.size(),
          "there must be a colour for each of {} vertices, got {}", mesh.vertices_m.size(),
          surface.vertex_colours.size());
  std::vector<glm::vec3> albedo(drawn.size(), glm::vec3(0.0F));
  const glm::dvec3 eye = camera.eye_m - mesh.origin_m;
  parallel_for(static_cast<std::int64_t>(drawn.size()), 4096, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (!drawn.hit(pixel)) return;
    const Triangle& t = mesh.triangles[drawn.primitive[pixel]];
    const glm::dvec3 p = eye + drawn.from_eye_m[pixel];
    const glm::dvec3 normal =
        area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]);
    glm::dvec3 colour(0.0);
    double sum = 0.0;
    for (std::size_t corner = 0; corner < 3; ++corner) {  // by the part opposite to it
      const glm::dvec3 part = area_normal(p, mesh.vertices_m[t[(corner + 1) % 3]],
                                          mesh.vertices_m[t[(corner + 2) % 3]]);
      const double weight = std::max(0.0, glm::dot(part, normal));
      sum += weight;
      colour += weight * glm::dvec3(surface.vertex_colours[t[corner]]);
    }
    albedo[pixel] = sum > 0.0 ? glm::vec3(colour / sum) : surface.vertex_colours[t[0]];
  });
  return albedo;
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
