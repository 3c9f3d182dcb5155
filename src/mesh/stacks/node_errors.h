// How far what a node draws may be from the finest surface, and that from what is drawn.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "core/box.h"
#include "mesh/stacks/finest_surface.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {

/// A bound of the distance from any point of some triangles to the nearest point of the other
/// surface.
struct PartError {
  Box box;               // of the triangles, metres relative to (field().origin_m, 0)
  double bound_m = 0.0;  // > 0; +inf where nothing is near
};
/// Of the parts of a node, by their place in it; parts that lie on the other surface are left out.
using PartErrors = std::vector<PartError>;

/// A node and the mesh that it draws, which depends on what lies beside it.
struct DrawnMesh {
  Node node;
  std::shared_ptr<const NodeMesh> mesh;
};

/// What is drawn, measured against the finest level's surface itself, both ways.
///
/// A measure is a function of the meshes that take part, whenever and by whatever thread it is
/// asked for; each is made once and kept.
class NodeErrors {
 public:
  /// Keeps references to both.
  NodeErrors(const StackDensities& densities, NodeCache& cache);

  /// From any point that the node draws to the finest surface.
  std::shared_ptr<const PartErrors> to_finest(const DrawnMesh& drawn);
  /// From any point of the finest surface within the node to one of the meshes, which are drawn in
  /// it and around it, the likeliest first.
  std::shared_ptr<const PartErrors> from_finest(
      const Node& node, std::span<const std::shared_ptr<const NodeMesh>> meshes);

  const FinestSurface& finest() const { return finest_; }

 private:
  using Asked = std::pair<Node, std::vector<const NodeMesh*>>;

  std::shared_ptr<const TriangleTree> tree(const NodeMesh& mesh);
  PartErrors measured(const Node& node, std::span<const std::span<const Corners>> triangles,
                      const Surface& surface) const;

  const StackDensities& densities_;
  FinestSurface finest_;
  std::mutex mutex_;  // of what follows, which is looked up and never walked
  std::map<const NodeMesh*, std::shared_ptr<const TriangleTree>> trees_;
  std::map<const NodeMesh*, std::shared_ptr<const PartErrors>> to_finest_;
  std::map<Asked, std::shared_ptr<const PartErrors>> from_finest_;
};

}  // namespace plumb::mesh::stacks
