// The finest level's surface, made where it is asked for.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/box.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/stack_densities.h"
#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {

/// Every place of a node among others of its own level.
Surroundings among_equals();

/// The corners of a node's triangles, metres relative to (field().origin_m, 0).
std::vector<Corners> triangles_of(const NodeMesh& mesh, const StackDensities& densities);

/// The 27 nodes of a level around a node, itself first.
template <class Visit>
void for_each_around(const Node& node, const Visit& visit) {
  visit(node);
  for (int k = 0; k < 27; ++k) {
    if (k != 13) visit(Node{node.level, node.at + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)});
  }
}

/// The meshes of level 0 in an octree of boxes, each made when it is first needed: to be the
/// nearest to a point, or because all within a node are asked for. Safe to ask from several
/// threads.
class FinestSurface {
 public:
  /// Keeps references to both.
  FinestSurface(const StackDensities& densities, NodeCache& cache);

  /// A box that holds what lies within a node; empty beyond the field.
  Box reach(const Node& node) const { return find(node).reach; }
  /// Makes what lies within some nodes, in parallel: it is not to be called from a parallel loop.
  void make(std::span<const Node> nodes) const;
  /// Those with triangles within a node of any level, in the order of the octree's children.
  std::vector<const TriangleTree*> within(const Node& node) const;
  /// What lies within a node and the 26 around it. `this` must outlive it.
  std::unique_ptr<Surface> around(const Node& node) const;

 private:
  struct Place {
    Place() = default;
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    ~Place() { delete tree.load(); }

    Node node;
    Box reach;  // where its surface may lie; empty beyond the field
    mutable std::once_flag divided;
    mutable std::unique_ptr<Place[]> children;                // eight; none on level 0
    mutable std::atomic<const TriangleTree*> tree = nullptr;  // of level 0, once it is made
  };
  class Around;

  void set(Place& place, const Node& node) const;
  const Place* children(const Place& place) const;
  const TriangleTree& tree(const Place& place) const;
  const Place& find(const Node& node) const;
  void collect(const Place& place, std::vector<const Place*>& places) const;
  void look_for(const Place& place, const glm::dvec3& point, NearestTriangle& nearest) const;

  const StackDensities& densities_;
  NodeCache& cache_;
  Octree octree_;
  Place root_;
};

}  // namespace plumb::mesh::stacks
