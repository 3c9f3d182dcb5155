// How far what a node draws may be from what it stands for.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/camera.h"
#include "mesh/stacks/node_mesh.h"
#include "mesh/stacks/octree.h"

namespace plumb::mesh::stacks {

/// What a camera asks for.
struct Allowed {
  std::function<bool(const Box&)> is_wanted;  // by a box, metres relative to (field().origin_m, 0)
  /// Whether such a distance is too much for points of a box; true of a larger one where it is of
  /// that. So it is of a larger box.
  std::function<bool(const Box&, double distance_m)> is_over;
};

/// A node and the mesh that it draws, which depends on what lies beside it.
struct DrawnMesh {
  Node node;
  std::shared_ptr<const NodeMesh> mesh;
};

using NodeMeshes = std::vector<std::shared_ptr<const NodeMesh>>;

/// Errors of nodes' meshes, measured in parts of a node. A measure is a function of the meshes that
/// take part, whenever and by whatever thread it is asked for.
class Errors {
 public:
  virtual ~Errors() = default;

  /// A box that holds what a node draws and what that stands for.
  virtual Box reach(const Node& node) const = 0;
  /// A bound of how far a point of a box that is in view and one at such a distance are seen apart,
  /// pixels.
  virtual double apart_px(const Camera& camera, const Box& box, double distance_m) const = 0;
  /// Before is_over_among_equals() is asked of others, in parallel: nodes of level 0.
  virtual void make(std::span<const Node> finest) const = 0;
  /// Of a node among others of its level. `around`: its mesh and those beside it, its own first.
  virtual bool is_over_among_equals(const DrawnMesh& drawn,
                                    const std::function<NodeMeshes()>& around,
                                    const Allowed& allowed) = 0;
  /// The boxes of parts that are over. `around`: what is drawn in the node and beside it, its own
  /// first.
  virtual std::vector<Box> over(const DrawnMesh& drawn, const NodeMeshes& around,
                                const Allowed& allowed) = 0;
};

}  // namespace plumb::mesh::stacks
