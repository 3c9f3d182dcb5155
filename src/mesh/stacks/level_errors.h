// How far each level's surface is from the finest one.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {

/// A node's surface as it is among nodes of its own level, and bounds of its distance to the finest
/// level's, metres.
struct NodeError {
  TriangleTree triangles;
  double to_finest_m = 0.0;    // from any point of it to the nearest of the finest surface
  double from_finest_m = 0.0;  // from any point of the finest surface within the node to this
                               // level's surface; +inf where that has vanished
  double worst_m() const { return to_finest_m > from_finest_m ? to_finest_m : from_finest_m; }
};

/// Of every node of every level of a field.
///
/// Each level is measured against the next finer one alone, in a node and all around it; what is
/// left is the sum over the levels: on the way to the finest surface no point goes farther than the
/// steps together.
class LevelErrors {
 public:
  /// Makes the meshes of all levels: some four thirds of the finest one's work.
  LevelErrors(const StackDensities& densities, NodeCache& cache);

  /// Null where the node has no surface, and the finest one has none there either.
  const NodeError* find(const Node& node) const;
  /// The error of a node that has none is zero.
  double worst_m(const Node& node) const;
  /// A distance below which pieces of a level's surfaces are not cut further: a 64th of its voxel.
  double fine_m(int level) const;
  /// The trees of the nodes of a level within one of a node, itself included.
  std::vector<const TriangleTree*> trees_around(const Node& node) const;

 private:
  using Level = std::unordered_map<Node, NodeError, NodeHash>;  // looked up, never walked

  void add_level(int level, const Octree& octree, NodeCache& cache);
  double step_to_finer(const Node& node, const NodeError& error) const;
  double step_from_finer(const Node& node) const;
  void sum_up(const std::vector<Node>& nodes, const std::vector<double>& from_finer);

  const StackDensities* densities_;
  std::vector<Level> levels_;
};

/// The corners of a node's triangles, metres relative to (field().origin_m, 0).
std::vector<Corners> triangles_of(const NodeMesh& mesh, const StackDensities& densities);

/// The 27 nodes of a level around a node.
template <class Visit>
void for_each_around(const Node& node, const Visit& visit) {
  for (int k = 0; k < 27; ++k)
    visit(Node{node.level, node.at + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)});
}

}  // namespace plumb::mesh::stacks
