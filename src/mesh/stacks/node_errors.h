// How far what a node draws may be from the finest surface, and that from what is drawn.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

#include "core/box.h"
#include "mesh/stacks/finest_surface.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/surface_distance.h"
#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {

/// Some triangles, and the distance from their points to the nearest of another surface.
struct PartError {
  Box box;             // of the triangles, metres relative to (field().origin_m, 0)
  double error_m = 0;  // +inf where nothing is near
};

/// A node and the mesh that it draws, which depends on what lies beside it.
struct DrawnMesh {
  Node node;
  std::shared_ptr<const NodeMesh> mesh;
};

/// What is drawn, measured against the finest level's surface itself, both ways, in parts of a
/// node: 4 x 4 x 4 voxels of it.
///
/// A measure is a function of the meshes that take part, whenever and by whatever thread it is
/// asked for; each is made when it is first asked for, and kept.
class NodeErrors {
 public:
  /// Whether a part is asked for, by its box or a larger one.
  using IsWanted = std::function<bool(const Box&)>;
  /// A bound of what all points of a part have, from above; or what some of its points have, for a
  /// fraction of the work, which is never above that.
  enum class Depth { SomePoints, AllPoints };

  /// Keeps references to both.
  NodeErrors(const StackDensities& densities, NodeCache& cache);

  /// From any point that the node draws to the finest surface.
  std::vector<PartError> to_finest(const DrawnMesh& drawn, const IsWanted& is_wanted,
                                   Depth depth = Depth::AllPoints);
  /// From any point of the finest surface within the node to one of the meshes, which are drawn in
  /// it and around it, the likeliest first.
  std::vector<PartError> from_finest(const Node& node,
                                     std::span<const std::shared_ptr<const NodeMesh>> meshes,
                                     const IsWanted& is_wanted, Depth depth = Depth::AllPoints);

  const FinestSurface& finest() const { return finest_; }

 private:
  struct Part {
    Box box;
    double some_m = -1.0, all_m = -1.0;  // < 0: not measured yet
  };
  // A node, the node that the parts are in, which is as fine or finer, and what is drawn.
  using Key = std::tuple<Node, Node, std::vector<const NodeMesh*>>;
  struct Question;

  std::shared_ptr<const TriangleTree> tree(const NodeMesh& mesh);
  std::shared_ptr<const Surface> drawn_surface(const std::vector<const NodeMesh*>& meshes);
  void answer(const Question& question, std::vector<PartError>& errors);
  std::vector<Part> known_parts(const Question& question);

  const StackDensities& densities_;
  FinestSurface finest_;
  std::mutex mutex_;  // of what follows, which is looked up and never walked
  std::map<const NodeMesh*, std::shared_ptr<const TriangleTree>> trees_;
  std::map<Key, std::vector<Part>> to_finest_, from_finest_;
};

}  // namespace plumb::mesh::stacks
