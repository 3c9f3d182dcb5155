// A tree that follows a moving camera a few nodes a frame.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "mesh/stacks/octree.h"

namespace plumb::mesh::stacks {

/// What one frame changed.
struct TreeChange {
  int splits = 0, merges = 0;
  int updated = 0;  // meshes that had to be made: of new nodes, and of those beside them
  int wanting = 0;  // splits and merges that the budget left for later frames
};

/// Splits and merges of one tree towards another, at most `budget` meshes a frame.
///
/// A node that has no surface, as most have none, costs no mesh. The coarsest splits come first,
/// then the finest merges. A split that balance asks for is made with it; a merge that would break
/// balance waits. One change is made in every frame, whatever it takes, so that a small budget only
/// delays.
///
///   (1) The tree is balanced after every frame.
///   (2) With a budget of 0, which is none, it is the tree aimed at after one frame.
///   (3) Frames that aim at one tree reach it.
/// Source: [Löffler, Müller & Schumann 2011, section 4]: some 40 nodes a frame, a split updates 8,
/// a merge the node and up to 24 beside it.
class AmortisedTree {
 public:
  /// Whether a node among such others has a mesh to be made.
  using HasMesh = std::function<bool(const Node&, const Surroundings&)>;

  /// has_mesh  a function of its arguments alone; empty: every node has one
  explicit AmortisedTree(const glm::ivec3& size, HasMesh has_mesh = {})
      : tree_(size), has_mesh_(std::move(has_mesh)) {}

  const Octree& tree() const { return tree_; }
  TreeChange step(const Octree& aim, int budget);

 private:
  bool may_merge(const Node& node, const Octree& aim) const;
  std::vector<Node> wanted(const Octree& aim) const;
  bool pass(const Octree& aim, int budget, TreeChange& change);

  Octree tree_;
  HasMesh has_mesh_;
};

}  // namespace plumb::mesh::stacks
