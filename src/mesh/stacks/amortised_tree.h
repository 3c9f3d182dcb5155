// A tree that follows a moving camera a few nodes a frame.
#pragma once

#include <vector>

#include "mesh/stacks/octree.h"

namespace plumb::mesh::stacks {

/// What one frame changed.
struct TreeChange {
  int splits = 0, merges = 0;
  int updated = 0;  // meshes of nodes that had to be made: new nodes, and those beside them
  int wanting = 0;  // splits and merges that the budget left for later frames
};

/// Splits and merges of one tree towards another, at most `budget` meshes a frame.
///
/// The coarsest splits come first, then the finest merges. A split that balance asks for is made
/// with it; a merge that would break balance waits. One change is made in every frame, whatever it
/// takes, so that a small budget only delays.
///
///   (1) The tree is balanced after every frame.
///   (2) With a budget of 0, which is none, it is the tree aimed at after one frame.
///   (3) Frames that aim at one tree reach it.
/// Source: [Löffler, Müller & Schumann 2011, section 4]: some 40 nodes a frame, a split updates 8,
/// a merge the node and up to 24 beside it.
class AmortisedTree {
 public:
  explicit AmortisedTree(const glm::ivec3& size) : tree_(size) {}

  const Octree& tree() const { return tree_; }
  TreeChange step(const Octree& aim, int budget);

 private:
  bool may_merge(const Node& node, const Octree& aim) const;
  std::vector<Node> wanted(const Octree& aim) const;
  bool pass(const Octree& aim, int budget, TreeChange& change);

  Octree tree_;
};

}  // namespace plumb::mesh::stacks
