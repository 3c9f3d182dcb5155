// Surfaces of stacks, drawn on chosen levels, and what is wrong with them.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "mesh/stacks/joined_surface.h"
#include "mesh/stacks/stacks.h"
#include "support/face_checks.h"

namespace plumb::test_support {

/// A field of `columns` x `rows` stacks and `high` voxels of a metre; `layers_at(i, j)` gives each.
template <class LayersAt>
terrain::StackField stacks_where(int columns, int rows, int high, const LayersAt& layers_at) {
  terrain::StackField field;
  field.columns = columns;
  field.rows = rows;
  field.voxels = high;
  field.materials = {{"air", glm::dvec3(0.0)}, {"rock"}, {"sand"}};
  terrain::StackWriter writer(field);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::vector<terrain::Layer> layers = layers_at(i, j);
      writer.add(layers);
    }
  }
  return field;
}

/// Parameters with a filter of this radius; 0: densities stay what they are.
inline mesh::stacks::Parameters filtered(
    int radius, mesh::stacks::Variant variant = mesh::stacks::Variant::Conservative) {
  mesh::stacks::Parameters parameters;
  parameters.variant = variant;
  parameters.filter.radius = radius;
  return parameters;
}

/// Of any octree, balanced or not: its nodes' meshes, joined, in metres as StackDensities has them.
inline TriangleMesh surface_of(const mesh::stacks::Prepared& prepared,
                               const mesh::stacks::Octree& octree) {
  const auto nodes = octree.drawn();
  const auto meshes = prepared.cache->meshes(octree, nodes);
  std::vector<const mesh::stacks::NodeMesh*> pointers;
  for (const auto& mesh : meshes) pointers.push_back(mesh.get());
  const mesh::stacks::JoinedSurface surface = mesh::stacks::joined(pointers);
  TriangleMesh triangles;
  for (const glm::dvec3& place : surface.position)
    triangles.vertices_m.push_back(prepared.densities->metres(place));
  for (const mesh::stacks::Face& face : surface.faces) {
    triangles.triangles.push_back({face[0], face[1], face[2]});
    if (face[3] != mesh::stacks::kNoCorner)
      triangles.triangles.push_back({face[0], face[2], face[3]});
  }
  return triangles;
}

/// Everything on one level, or on the coarsest that there is.
inline TriangleMesh surface_on(const mesh::stacks::Prepared& prepared, int level) {
  mesh::stacks::Octree octree(prepared.densities->size());
  octree.divide([&](const mesh::stacks::Node& node) { return node.level > level; });
  return surface_of(prepared, octree);
}

struct StackMeshCheck {
  int open = 0;        // edges with more faces one way than the other, off the terrain's rim
  int crowded = 0;     // edges of more than two faces
  int torn = 0;        // vertices off the rim whose faces are not one fan
  int degenerate = 0;  // triangles without area
  double lowest_m = std::numeric_limits<double>::infinity();
  double highest_m = -std::numeric_limits<double>::infinity();

  bool is_manifold() const { return open + crowded + torn == 0; }
};

/// The rim is where the outermost stacks stand: there a surface ends.
inline StackMeshCheck check_stack_mesh(const TriangleMesh& mesh, const terrain::StackField& field) {
  const double east_m = (field.columns - 1) * field.dx_m, north_m = (field.rows - 1) * field.dy_m;
  const auto is_rim = [&](std::uint32_t v) {
    const glm::dvec3& at = mesh.vertices_m[v];
    return at.x <= 0.0 || at.y <= 0.0 || at.x >= east_m || at.y >= north_m;
  };
  StackMeshCheck check;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<int, int>> edges;
  std::vector<std::vector<testing::FarSide>> rings(mesh.vertices_m.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      auto& [up, down] = edges[std::minmax(a, b)];
      ++(a < b ? up : down);
      rings[a].push_back({a, b, t[(k + 2) % 3]});
    }
    const glm::dvec3 n =
        area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]);
    check.degenerate += n == glm::dvec3(0.0) ? 1 : 0;
  }
  for (const auto& [edge, ways] : edges) {
    check.open += ways.first != ways.second && !(is_rim(edge.first) && is_rim(edge.second)) ? 1 : 0;
    check.crowded += ways.first + ways.second > 2 ? 1 : 0;
  }
  for (std::uint32_t v = 0; v < rings.size(); ++v) {
    check.torn += !is_rim(v) && !rings[v].empty() && !testing::is_one_fan(rings[v], false) ? 1 : 0;
    check.lowest_m = std::min(check.lowest_m, mesh.vertices_m[v].z);
    check.highest_m = std::max(check.highest_m, mesh.vertices_m[v].z);
  }
  return check;
}

}  // namespace plumb::test_support
