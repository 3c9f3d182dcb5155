// Which nodes of the tree are drawn, and as what, for one camera.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/triangle_mesh.h"
#include "slicing/bundle_choice.h"
#include "slicing/cost_profile.h"
#include "slicing/slice_bundle.h"
#include "slicing/slicing_tree.h"

namespace plumb::slicing {

struct CutOptions {
  Variant variant = Variant::Conservative;
  double tolerance_px = 1.0;    // gap between slices (published), error (conservative); > 0
  bool hybrid = true;           // polygons where they cost less; else only where slices cannot be
  double descend_factor = 0.9;  // c: descend if a node costs more than c times its children; > 0
  CostProfile profile;
  bool borders = true;  // of published bundles
};

enum class NodeUse : std::uint8_t { Nothing, Inner, Bundle, Polygons };

/// What a ray walks: nodes of the tree below which slices lie, each after those above it.
struct SliceBranch {
  Box reach;                            // of all slices in it
  std::uint32_t bundle = kNoPrimitive;  // of a leaf of the walk
  std::uint32_t below[4] = {kNoPrimitive, kNoPrimitive, kNoPrimitive,
                            kNoPrimitive};  // SW, SE, NW, NE; kNoPrimitive: no slices
};

/// A cut through the tree: every path from the root ends in one used node, or in nothing to see.
struct SlicingCut {
  std::vector<NodeUse> use;             // a node each
  std::vector<SliceBundle> bundles;     // front to back
  std::vector<std::uint32_t> polygons;  // nodes, front to back
  std::vector<SliceBranch> branches;    // the root is the last; empty without slices
  std::int64_t slices = 0;              // planes of all bundles, closing quads included
  std::int64_t nodes_visited = 0;
  double cost_s = 0.0;  // as the model predicts it
};

/// Top-down and greedy: a node is descended from if its own cost is greater than descend_factor
/// times the sum of its children's own; one that meets the near plane or a side of the frustum
/// always. Where the descent stops, polygons are chosen if they cost less. What may not be sliced
/// there is polygons as a leaf.
///
/// camera  relative to the terrain's origin
/// Source: [Röttger & Ertl 2001], section 4.
SlicingCut cut_tree(const SlicingTree& tree, const Camera& camera, const CutOptions& options);

/// The cut of least cost_s among all that the same rules allow, by dynamic programming over the
/// tree: what the heuristic is measured by. descend_factor has no part in it. Every node that may
/// be seen is priced, so it takes longer.
SlicingCut optimal_cut(const SlicingTree& tree, const Camera& camera, const CutOptions& options);

}  // namespace plumb::slicing
