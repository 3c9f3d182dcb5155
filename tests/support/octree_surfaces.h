// Random octrees over stacks, and the surfaces that their nodes join to.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

#include "core/hash.h"
#include "mesh/stacks/joined_surface.h"
#include "mesh/stacks/node_mesh.h"
#include "mesh/stacks/octree.h"

namespace plumb::testing {

inline std::uint64_t hash_of(std::uint64_t seed, int level, const glm::ivec3& p) {
  return Checksum().add(seed).add(level).add(p.x).add(p.y).add(p.z).value();
}

/// The root is divided, of the other nodes one in `one_in`; then balanced.
inline mesh::stacks::Octree random_octree(const glm::ivec3& size, std::uint64_t seed, int one_in) {
  mesh::stacks::Octree octree(size);
  octree.divide([&](const mesh::stacks::Node& node) {
    return node.level == octree.root_level() ||
           hash_of(seed ^ 77U, node.level, node.at) % static_cast<std::uint64_t>(one_in) == 0;
  });
  octree.balance();
  return octree;
}

inline mesh::stacks::JoinedSurface surface_of(const mesh::stacks::Octree& octree,
                                              const mesh::stacks::DensitySource& densities,
                                              const mesh::stacks::NodeMeshOptions& options) {
  std::vector<mesh::stacks::NodeMesh> meshes;
  for (const mesh::stacks::Node& node : octree.drawn())
    meshes.push_back(node_mesh(node, octree.surroundings(node), densities, options));
  std::vector<const mesh::stacks::NodeMesh*> pointers;
  for (const mesh::stacks::NodeMesh& mesh : meshes) pointers.push_back(&mesh);
  return mesh::stacks::joined(pointers);
}

}  // namespace plumb::testing
