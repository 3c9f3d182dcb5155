// Node meshes, each made once.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "mesh/stacks/node_mesh.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/stack_densities.h"

namespace plumb::mesh::stacks {

/// The meshes of nodes by what lies beside them. Safe to ask from several threads: whoever asks for
/// a mesh is given the same one, which lives as long as the cache, so that what is known of a mesh
/// may be kept by its address.
class NodeCache {
 public:
  NodeCache(std::shared_ptr<const StackDensities> densities, NodeMeshOptions options)
      : densities_(std::move(densities)), options_(std::move(options)) {}

  /// Of every drawn node of a balanced tree, in its order; those that are not there yet are made,
  /// in parallel.
  std::vector<std::shared_ptr<const NodeMesh>> meshes(const Octree& octree,
                                                      std::span<const Node> nodes);
  /// Of one node.
  std::shared_ptr<const NodeMesh> mesh(const Node& node, const Surroundings& around);
  /// Of all meshes that are kept.
  std::size_t bytes() const;

 private:
  using Key = std::pair<Node, std::uint64_t>;  // a node and its surroundings

  std::shared_ptr<const NodeMesh> made(const Node& node, const Surroundings& around) const;

  std::shared_ptr<const StackDensities> densities_;
  NodeMeshOptions options_;
  mutable std::mutex mutex_;
  std::map<Key, std::shared_ptr<const NodeMesh>> meshes_;
};

}  // namespace plumb::mesh::stacks
