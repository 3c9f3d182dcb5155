// What holds of a mesh of quads that is the border of a solid.
#pragma once

#include <glm/vec3.hpp>

#include "core/triangle_mesh.h"
#include "mesh/dual_contouring/quadrangulate.h"
#include "support/face_checks.h"

namespace plumb::testing {

struct QuadMeshCheck : FaceCheck {
  int unused_vertices = 0;
  int euler = 0;  // vertices - edges + faces
  double volume = 0.0;
};

inline QuadMeshCheck check_quads(const mesh::dual_contouring::QuadMesh& mesh) {
  QuadMeshCheck check{check_faces(mesh.quads)};
  check.unused_vertices = static_cast<int>(mesh.position.size()) - check.vertices;
  check.euler = check.vertices - check.edges + static_cast<int>(mesh.quads.size());
  const TriangleMesh triangles = mesh::dual_contouring::to_triangles(mesh);
  for (const auto& [a, b, c] : triangles.triangles) {
    const glm::dvec3 n =
        area_normal(triangles.vertices_m[a], triangles.vertices_m[b], triangles.vertices_m[c]);
    const glm::dvec3& p = triangles.vertices_m[a];
    check.volume += (n.x * p.x + n.y * p.y + n.z * p.z) / 6.0;
  }
  return check;
}

}  // namespace plumb::testing
