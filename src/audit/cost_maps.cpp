#include "audit/cost_maps.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

double density_of(const TriangleMesh& mesh, std::uint32_t triangle, const Camera& camera) {
  std::array<glm::dvec2, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 from_eye =
        mesh.vertices_m[mesh.triangles[triangle][k]] + (mesh.origin_m - camera.eye_m);
    const double depth_m = glm::dot(from_eye, camera.forward);
    if (!(depth_m > camera.near_m)) return 0.0;
    corners[k] = {camera.gamma_h * glm::dot(from_eye, camera.right) / depth_m,
                  camera.gamma_v * glm::dot(from_eye, camera.up) / depth_m};
  }
  const glm::dvec2 u = corners[1] - corners[0], v = corners[2] - corners[0];
  const double area_px = 0.5 * std::abs(u.x * v.y - u.y * v.x);
  return area_px > 0.0 ? 1.0 / area_px : 0.0;
}

}  // namespace

std::vector<float> triangles_a_pixel(const DrawnSurface& surface, const HitImage& drawn,
                                     const Camera& camera) {
  if (surface.mesh == nullptr) return {};
  std::vector<float> density(drawn.size(), 0.0f);
  parallel_for(static_cast<std::int64_t>(drawn.size()), 4096, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (drawn.hit(pixel))
      density[pixel] =
          static_cast<float>(density_of(*surface.mesh, drawn.primitive[pixel], camera));
  });
  return density;
}

}  // namespace plumb::audit
