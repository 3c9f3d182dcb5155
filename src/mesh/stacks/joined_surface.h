// The meshes of nodes as one surface, shared vertices being one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/stacks/node_mesh.h"

namespace plumb::mesh::stacks {

struct JoinedSurface {
  std::vector<VertexName> names;
  std::vector<glm::dvec3> position, normal;  // as NodeMesh has them
  std::vector<glm::vec3> colour;             // empty where meshes have none
  std::vector<Face> faces;
  std::vector<std::uint32_t> first_face;  // of each node's mesh, and their number at the end
};

/// Vertices and faces in the order of the meshes; a vertex is the first mesh's that names it.
///
///   (1) Vertices are joined by name, never by place.
JoinedSurface joined(std::span<const NodeMesh* const> meshes);

}  // namespace plumb::mesh::stacks
