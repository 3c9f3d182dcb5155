#include "reference/mesh_triangles.h"

#include <cmath>

#include "core/check.h"

namespace plumb::reference {

MeshTriangles::MeshTriangles(const TriangleMesh& mesh) : mesh_(&mesh) {
  require(mesh.triangles.size() < kNoPrimitive,
          "a mesh may have at most 2^32 - 2 triangles, got {}", mesh.triangles.size());
  for (const glm::dvec3& v : mesh.vertices_m) {
    require(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z),
            "a mesh's vertices must be finite, got ({}, {}, {})", v.x, v.y, v.z);
  }
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      require(corner < mesh.vertices_m.size(),
              "a triangle's corners must be vertices: corner {} of {}", corner,
              mesh.vertices_m.size());
    }
  }
}

Box MeshTriangles::box(std::uint32_t k) const {
  Box box;
  for (const glm::dvec3& corner : corners(k)) box.add(corner);
  return box;
}

void MeshTriangles::meet(std::uint32_t k, const RayFrame& frame, double t_min, double t_max,
                         RayHit& best, Scratch& /*scratch*/) const {
  const std::array<glm::dvec3, 3> c = corners(k);
  const glm::dvec3& eye = frame.origin_m();
  const double t = meet_triangle(frame.place(c[0] - eye), frame.place(c[1] - eye),
                                 frame.place(c[2] - eye), t_min, t_max);
  offer(best, t, k);
}

}  // namespace plumb::reference
