// How far the surface that is drawn may be from the finest one, node by node.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
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
  /// Keeps references to both. What was measured once is kept as well, for the next selection.
  DrawnErrors(const StackDensities& densities, const LevelErrors& levels);

  /// One for each node, in the order given; of those that are not wanted zero.
  std::vector<double> bounds_m(const Octree& octree, std::span<const Node> nodes,
                               std::span<const std::shared_ptr<const NodeMesh>> meshes,
                               std::span<const std::uint8_t> wanted);

 private:
  struct Drawn {
    const Octree& octree;
    std::span<const Node> nodes;
    std::unordered_map<Node, const TriangleTree*, NodeHash> trees = {};  // of each that is drawn
    std::unordered_map<Node, double, NodeHash> missed =
        {};  // of places of a level, by what is drawn
  };
  using Asked = std::pair<Node, std::vector<const TriangleTree*>>;

  void plant(Drawn& drawn, std::span<const std::shared_ptr<const NodeMesh>> meshes);
  void measure_levels(Drawn& drawn, std::span<const std::uint8_t> wanted);
  double drawn_to_finest(const Drawn& drawn, const Node& node) const;
  bool is_fitted(const Drawn& drawn, const Node& node) const;
  Asked around(const Drawn& drawn, const Node& node) const;
  void collect(const Drawn& drawn, const Node& node, std::vector<const TriangleTree*>& trees) const;

  const StackDensities& densities_;
  const LevelErrors& levels_;
  std::map<const NodeMesh*, TriangleTree> planted_;
  std::map<Asked, double> measured_;  // looked up, never walked
};

}  // namespace plumb::mesh::stacks
