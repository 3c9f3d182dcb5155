#include "mesh/dual_contouring/quadrangulate.h"

#include "mesh/dual_contouring/attributes.h"

namespace plumb::mesh::dual_contouring {

namespace {

QuadMesh mesh_of(const Lattice<float>& density, const Options& options, const ActiveCells& active) {
  return {vertex_positions(density, active, options.placement), quads_of(active)};
}

}  // namespace

QuadMesh quadrangulate(const Lattice<float>& density, const Options& options) {
  return mesh_of(density, options, allocate(density, options.variant));
}

QuadMesh quadrangulate(const Lattice<float>& density, const Options& options,
                       const LatticeBox& voxels) {
  return mesh_of(density, options, allocate(density, options.variant, voxels));
}

TriangleMesh to_triangles(const QuadMesh& mesh, const glm::dvec3& origin_m,
                          const glm::dvec3& spacing_m) {
  TriangleMesh triangles;
  triangles.origin_m = origin_m;
  triangles.vertices_m.reserve(mesh.position.size());
  for (const glm::dvec3& position : mesh.position)
    triangles.vertices_m.push_back(position * spacing_m);
  triangles.triangles.reserve(2 * mesh.quads.size());
  for (const auto& [a, b, c, d] : mesh.quads) {
    triangles.triangles.push_back({a, b, c});
    triangles.triangles.push_back({a, c, d});
  }
  return triangles;
}

}  // namespace plumb::mesh::dual_contouring
