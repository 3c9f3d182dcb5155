#include "slicing/slicing_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_terrain.h"

namespace plumb::slicing {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

// [Röttger & Ertl 2001]: "a terrain of 1025 x 1025 vertices has 21,845 nodes".
TEST(SlicingTree, Has21845NodesFor1025Samples) {
  Heightfield field;
  field.heights_m = Grid<float>(1025, 1025, 3.0f);
  const SlicingTree tree(field, Diagonal::Alternating);
  EXPECT_EQ(tree.count(), 21845u);
  EXPECT_EQ(tree.levels(), 8);
  EXPECT_TRUE(tree.is_leaf(21844));
  EXPECT_FALSE(tree.is_leaf(SlicingTree::first_of(7) - 1));
}

TEST(SlicingTree, HasChildrenThatShareTheirParentsMiddle) {
  const Heightfield field = test_support::rough_terrain(65, 65, 3, 40.0, 0.0, 10.0, 7.0);
  const SlicingTree tree(field, Diagonal::Fixed, 4);
  for (std::uint32_t index = 0; index < SlicingTree::first_of(tree.levels() - 1); ++index) {
    const SlicingNode& node = tree.node(index);
    const auto children = tree.children(index);
    for (const std::uint32_t child : children)
      EXPECT_EQ(tree.level_of(child), tree.level_of(index) + 1);
    EXPECT_EQ(tree.node(children[0]).i0, node.i0);
    EXPECT_EQ(tree.node(children[0]).i1, tree.node(children[1]).i0);
    EXPECT_EQ(tree.node(children[0]).j1, tree.node(children[2]).j0);
    EXPECT_EQ(tree.node(children[3]).i1, node.i1);
    EXPECT_EQ(tree.node(children[3]).j1, node.j1);
  }
}

// Sizes that are no power of two, one of them smaller than a leaf across; voids.
TEST(SlicingTree, BoxesHoldTheirSamplesAndTellTheirSlope) {
  for (const auto& [columns, rows, voids] :
       {std::tuple{65, 65, 0.0}, {70, 33, 0.1}, {6, 101, 0.02}, {40, 40, 1.0}}) {
    const Heightfield field = test_support::rough_terrain(columns, rows, 9, 30.0, voids, 10.0, 7.0);
    const SlicingTree tree(field, Diagonal::Alternating);
    for (std::uint32_t index = 0; index < tree.count(); ++index) {
      const SlicingNode& node = tree.node(index);
      double low = INFINITY, high = -INFINITY, steepest = 0.0;
      bool complete = node.i1 > node.i0 && node.j1 > node.j0;
      for (int j = node.j0; j <= node.j1 && complete; ++j) {
        for (int i = node.i0; i <= node.i1; ++i) {
          const double height = field.heights_m(i, j);
          if (std::isnan(height)) continue;
          low = std::min(low, height);
          high = std::max(high, height);
          // Edges of triangles are no steeper than the triangles.
          if (i < node.i1 && !std::isnan(field.heights_m(i + 1, j)) && node.complete)
            steepest = std::max(steepest, std::abs(field.heights_m(i + 1, j) - height) / 10.0);
          if (j < node.j1 && !std::isnan(field.heights_m(i, j + 1)) && node.complete)
            steepest = std::max(steepest, std::abs(field.heights_m(i, j + 1) - height) / 7.0);
        }
      }
      if (!complete) {
        EXPECT_TRUE(node.empty());
        continue;
      }
      EXPECT_EQ(node.empty(), !(low <= high));
      if (node.empty()) continue;
      EXPECT_EQ(node.box.low, glm::dvec3(node.i0 * 10.0, node.j0 * 7.0, low));
      EXPECT_EQ(node.box.high, glm::dvec3(node.i1 * 10.0, node.j1 * 7.0, high));
      EXPECT_GE(node.steepest * (1.0 + 1e-12), steepest);
      EXPECT_TRUE(node.complete || !node.inland);
    }
  }
}

TEST(SlicingTree, KnowsWhatTouchesARimOrAVoid) {
  Heightfield field;
  field.heights_m = Grid<float>(33, 33, 1.0f);
  field.heights_m.floats()(16, 16) = NAN;  // the corner of four leaves
  const SlicingTree tree(field, Diagonal::Alternating);
  int inland = 0;
  for (std::uint32_t index = SlicingTree::first_of(2); index < tree.count(); ++index) {
    inland += tree.node(index).inland ? 1 : 0;
    EXPECT_EQ(tree.node(index).complete, tree.node(index).i0 == 0 || tree.node(index).j0 == 0 ||
                                             tree.node(index).i1 == 32 || tree.node(index).j1 == 32)
        << index;
  }
  EXPECT_EQ(inland, 0);
}

TEST(SlicingTree, RefusesLeavesThatAreNone) {
  Heightfield field;
  field.heights_m = Grid<float>(33, 33, 1.0f);
  for (const int cells : {0, 1, 3, 7, 258}) {
    EXPECT_THROW(SlicingTree(field, Diagonal::Alternating, cells), std::invalid_argument) << cells;
  }
}

}  // namespace
}  // namespace plumb::slicing
