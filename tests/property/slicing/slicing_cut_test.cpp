// Cuts through the tree: what they cover, and how near to the best the heuristic comes.
#include "slicing/slicing_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/screen_error.h"
#include "support/random_slices.h"

namespace plumb::slicing {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::Random;

// Each leaf that may be seen lies under exactly one used node.
TEST(SlicingCut, CoversWhatMayBeSeenOnce) {
  Random random(42);
  for (std::uint32_t round = 0; round < 200; ++round) {
    const Heightfield field = test_support::random_ground(random, round);
    const SlicingTree tree(field, Diagonal::Alternating);
    const Camera camera =
        relative_to(test_support::random_view(random, field), field.world_origin_m());
    const CutOptions options = test_support::random_cut_options(random);
    const SlicingCut cut =
        random.chance(0.5) ? cut_tree(tree, camera, options) : optimal_cut(tree, camera, options);
    std::vector<int> used(tree.count(), 0);
    for (const SliceBundle& bundle : cut.bundles) ++used[bundle.node];
    for (const std::uint32_t node : cut.polygons) ++used[node];
    std::vector<int> above(tree.count(), 0);
    for (std::uint32_t index = 0; index < tree.count(); ++index) {
      above[index] += used[index];
      if (tree.is_leaf(index)) {
        EXPECT_LE(above[index], 1);
        const bool seen = !tree.node(index).empty() && may_be_in_view(camera, tree.node(index).box);
        EXPECT_TRUE(!seen || above[index] == 1) << round << ": " << index;
        continue;
      }
      for (const std::uint32_t child : tree.children(index)) above[child] += above[index];
    }
    EXPECT_GT(cut.cost_s, -1.0);
  }
}

// The least cost of all cuts, one after the other: 17 of a node with four leaves below four.
double least_of_all(const SlicingTree& tree, std::uint32_t index, const Camera& camera,
                    const CutOptions& options) {
  const SlicingNode& node = tree.node(index);
  if (node.empty() || !may_be_in_view(camera, node.box)) return 0.0;
  double children_s = tree.is_leaf(index) ? INFINITY : 0.0;
  if (!tree.is_leaf(index)) {
    for (const std::uint32_t child : tree.children(index))
      children_s += least_of_all(tree, child, camera, options);
  }
  bool inside = true;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 p = to_view(camera, node.box.corner(k));
    const glm::dvec2 px = view_to_pixel(camera, p);
    inside = inside && p.z > camera.near_m && px.x >= 0.0 && px.y >= 0.0 &&
             px.x <= camera.width_px && px.y <= camera.height_px;
  }
  BoxView view = view_of_box(node.box, camera, options.variant);
  view.distance_m = std::max(view.distance_m, camera.near_m);
  const double polygons_s = cost_of_polygons_s(node, view, camera, options.profile);
  const auto slices = inside ? price_bundle(node, index, camera, options.variant,
                                            options.tolerance_px, options.profile)
                             : std::nullopt;
  if (!slices) return tree.is_leaf(index) ? polygons_s : children_s;
  const double own_s = options.hybrid ? std::min(slices->cost_s, polygons_s) : slices->cost_s;
  return std::min(own_s, children_s);
}

TEST(OptimalCut, IsTheBestOfAllAndTheHeuristicNoBetter) {
  Random random(45);
  double worst = 1.0;
  for (std::uint32_t round = 0; round < 200; ++round) {
    const Heightfield field = test_support::random_ground(random, round);
    const SlicingTree tree(field, Diagonal::Alternating);
    const Camera camera =
        relative_to(test_support::random_view(random, field), field.world_origin_m());
    CutOptions options = test_support::random_cut_options(random);
    options.descend_factor = random.uniform(0.5, 1.0);
    const double least_s = least_of_all(tree, 0, camera, options);
    const SlicingCut best = optimal_cut(tree, camera, options);
    const SlicingCut greedy = cut_tree(tree, camera, options);
    // Sums of a few thousand positive terms in another order.
    EXPECT_NEAR(best.cost_s, least_s, 1e-11 * least_s);
    EXPECT_GE(greedy.cost_s, best.cost_s * (1.0 - 1e-11));
    if (best.cost_s > 0.0) worst = std::max(worst, greedy.cost_s / best.cost_s);
  }
  EXPECT_GT(worst, 1.0);  // the heuristic is one
  RecordProperty("heuristic over optimum, at most", std::to_string(worst));
}

}  // namespace
}  // namespace plumb::slicing
