// How far the surface that is drawn may be from the finest one, node by node.
#pragma once

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/stacks/level_errors.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"

namespace plumb::mesh::stacks {

/// Bounds for the drawn nodes of a balanced tree, metres: from any point that a node draws to the
/// nearest of the finest surface, and from any point of the finest surface within the node to the
/// nearest that is drawn.
///
/// A node among others of its level has its level's error. What is fitted to a coarser node beside
/// it lies elsewhere: by how much is measured against the level's own surface, both ways.
class DrawnErrors {
 public:
  DrawnErrors(const Octree& octree, std::span<const Node> nodes,
              std::span<const std::shared_ptr<const NodeMesh>> meshes,
              const StackDensities& densities, const LevelErrors& levels);

  /// One for each node, in the order given.
  std::vector<double> bounds_m();

 private:
  struct NodeHash {
    std::size_t operator()(const Node& node) const;
  };

  void plant_trees();
  double drawn_to_finest(std::size_t k) const;
  double level_to_drawn(const Node& node) const;
  void collect(const Node& node, std::vector<const TriangleTree*>& trees) const;
  double fine_m(const Node& node) const;

  const Octree& octree_;
  std::span<const Node> nodes_;
  std::span<const std::shared_ptr<const NodeMesh>> meshes_;
  const StackDensities& densities_;
  const LevelErrors& levels_;
  std::vector<std::uint8_t> fitted_;  // of each node: drawn otherwise than its level's own
  std::vector<TriangleTree> trees_;   // of each node that is fitted
  std::unordered_map<Node, std::size_t, NodeHash> place_;  // of a drawn node
};

}  // namespace plumb::mesh::stacks
