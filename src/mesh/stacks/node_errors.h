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
#include "mesh/stacks/errors.h"
#include "mesh/stacks/finest_surface.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/surface_distance.h"
#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {

/// Parts along a node's side.
inline constexpr int kParts = 4;

/// Triangles by the part of a box, `count` along each side, that their middle lies in or is nearest
/// to.
std::vector<std::vector<Corners>> parted(const std::vector<Corners>& triangles, const Box& box,
                                         int count);

/// What a node draws: its voxels and the cells that reach beyond them, a coarser level's included.
Box drawn_box(const StackDensities& densities, const Node& node);

/// What is drawn, measured against the finest level's surface itself, both ways, in parts of a
/// node: 4 x 4 x 4 voxels of it.
///
/// A measure is a function of the meshes that take part, whenever and by whatever thread it is
/// asked for; each is made when it is first asked for, and kept.
class NodeErrors final : public Errors {
 public:
  /// Whether a few points may tell, which never say that a part is over where all points do not.
  enum class Depth { SomePoints, AllPoints };

  /// Keeps references to both.
  NodeErrors(const StackDensities& densities, NodeCache& cache);

  /// The boxes of parts from which the finest surface is too far.
  std::vector<Box> over_to_finest(const DrawnMesh& drawn, const Allowed& allowed,
                                  Depth depth = Depth::AllPoints);
  /// The boxes of parts of the finest surface within the node that are too far from all meshes:
  /// those which are drawn in it and around it, its own first.
  std::vector<Box> over_from_finest(const Node& node,
                                    std::span<const std::shared_ptr<const NodeMesh>> meshes,
                                    const Allowed& allowed, Depth depth = Depth::AllPoints);

  Box reach(const Node& node) const override { return drawn_box(densities_, node); }
  double apart_px(const Camera& camera, const Box& box, double distance_m) const override;
  void make(std::span<const Node> finest) const override { finest_.make(finest); }
  bool is_over_among_equals(const DrawnMesh& drawn, const std::function<NodeMeshes()>& around,
                            const Allowed& allowed) override;
  std::vector<Box> over(const DrawnMesh& drawn, const NodeMeshes& around,
                        const Allowed& allowed) override;

 private:
  // Distances, < 0 where they are not measured yet: of a few points, never above `all_m`; a bound
  // of all, never below it; and the bound that decides.
  struct Part {
    Box box;
    double some_m = -1.0, rough_m = -1.0, all_m = -1.0;
  };
  // A node, the node that the parts are in, which is as fine or finer, and what is drawn.
  using Key = std::tuple<Node, Node, std::vector<const NodeMesh*>>;
  struct Question;

  std::shared_ptr<const TriangleTree> tree(const NodeMesh& mesh);
  std::shared_ptr<const Surface> drawn_surface(const std::vector<const NodeMesh*>& meshes);
  std::vector<Part> known_parts(const Question& question);
  template <class Measured>
  void measure(const Question& question, std::vector<Part>& parts, double Part::*distance_m,
               const std::vector<std::size_t>& wanted, const Measured& measured);
  void answer(const Question& question, std::vector<Box>& over);
  double fine_m(int level) const;

  const StackDensities& densities_;
  FinestSurface finest_;
  std::mutex mutex_;  // of what follows, which is looked up and never walked
  std::map<const NodeMesh*, std::shared_ptr<const TriangleTree>> trees_;
  std::map<Key, std::vector<Part>> to_finest_, from_finest_;
};

}  // namespace plumb::mesh::stacks
