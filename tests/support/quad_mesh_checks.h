// What holds of a mesh of quads that is the border of a solid.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"
#include "mesh/dual_contouring/quadrangulate.h"

namespace plumb::testing {

struct QuadMeshCheck {
  int edges = 0;
  int odd_edges = 0;      // not as many faces one way as the other: the mesh is open there
  int crowded_edges = 0;  // more than two faces
  int torn_vertices = 0;  // whose faces are not one fan
  int unused_vertices = 0;
  int euler = 0;  // vertices - edges + faces
  double volume = 0.0;

  bool is_closed() const { return odd_edges == 0; }
  bool is_manifold() const { return odd_edges + crowded_edges + torn_vertices == 0; }
};

// The faces round a vertex are one fan where their far sides (from the next corner to the one
// before) form one ring.
inline bool is_one_ring(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& sides) {
  std::map<std::uint32_t, std::uint32_t> next(sides.begin(), sides.end());
  if (next.size() != sides.size()) return false;
  std::size_t steps = 0;
  std::uint32_t at = sides.front().first;
  do {
    const auto found = next.find(at);
    if (found == next.end()) return false;
    at = found->second;
    ++steps;
  } while (at != sides.front().first && steps <= sides.size());
  return steps == sides.size();
}

inline QuadMeshCheck check_quads(const mesh::dual_contouring::QuadMesh& mesh) {
  QuadMeshCheck check;
  std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> edges;  // faces each way
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> rings(mesh.position.size());
  for (const auto& quad : mesh.quads) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t a = quad[k], b = quad[(k + 1) % 4];
      ++edges[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
      rings[a].emplace_back(b, quad[(k + 3) % 4]);
    }
  }
  for (const auto& [edge, faces] : edges) {
    check.odd_edges += faces[0] != faces[1] ? 1 : 0;
    check.crowded_edges += faces[0] + faces[1] > 2 ? 1 : 0;
  }
  for (const auto& ring : rings) {
    if (ring.empty())
      ++check.unused_vertices;
    else
      check.torn_vertices += is_one_ring(ring) ? 0 : 1;
  }
  check.edges = static_cast<int>(edges.size());
  check.euler = static_cast<int>(mesh.position.size()) - check.unused_vertices - check.edges +
                static_cast<int>(mesh.quads.size());
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
