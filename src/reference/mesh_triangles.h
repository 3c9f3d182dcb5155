// A mesh's triangles one by one, for a tree of boxes.
#pragma once

#include <array>
#include <cstdint>

#include "core/box.h"
#include "core/triangle_mesh.h"
#include "reference/ray_triangle.h"

namespace plumb::reference {

/// Keeps a reference to the mesh. Coordinates are relative to the mesh's origin.
class MeshTriangles {
 public:
  /// Throws std::invalid_argument unless corners are vertices, vertices finite and the triangles
  /// countable.
  explicit MeshTriangles(const TriangleMesh& mesh);

  std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_->triangles.size()); }
  std::array<glm::dvec3, 3> corners(std::uint32_t k) const {
    const Triangle& triangle = mesh_->triangles[k];
    return {mesh_->vertices_m[triangle[0]], mesh_->vertices_m[triangle[1]],
            mesh_->vertices_m[triangle[2]]};
  }
  Box box(std::uint32_t k) const;
  /// Improves `best` by triangle k if the ray meets it at t in [t_min, t_max]; of equal t the
  /// lowest index stays.
  struct Scratch {};  // nothing is kept
  void meet(std::uint32_t k, const RayFrame& frame, double t_min, double t_max, RayHit& best,
            Scratch& scratch) const;

 private:
  const TriangleMesh* mesh_;
};

}  // namespace plumb::reference
