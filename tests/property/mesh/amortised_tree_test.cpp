// A tree that follows an aim by few meshes a frame.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/hash.h"
#include "mesh/stacks/amortised_tree.h"

namespace plumb::mesh::stacks {
namespace {

const glm::ivec3 kSize(200, 150, 70);

// Divided towards a corner that wanders: what a camera asks for.
Octree aim_at(int frame) {
  Octree tree(kSize);
  const glm::ivec3 eye(25 * frame % 200, 17 * frame % 150, 30);
  tree.divide([&](const Node& node) {
    const int side = kNodeVoxels << node.level;
    int away = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const int low = node.at[axis] * side;
      away = std::max({away, low - eye[axis], eye[axis] - low - side});
    }
    return away < side;
  });
  tree.balance();
  return tree;
}

TEST(AmortisedTree, IsTheAimAtOnceWithoutABudget) {
  AmortisedTree tree(kSize);
  for (int frame = 0; frame < 6; ++frame) {
    tree.step(aim_at(frame), 0);
    EXPECT_EQ(tree.tree().drawn(), aim_at(frame).drawn()) << frame;
  }
}

TEST(AmortisedTree, StaysBalancedWithinItsBudgetAndArrives) {
  constexpr int kBudget = 40;
  AmortisedTree tree(kSize);
  tree.step(aim_at(0), 0);
  int over = 0, waited = 0;
  for (int frame = 1; frame < 8; ++frame) {
    const TreeChange change = tree.step(aim_at(frame), kBudget);
    EXPECT_TRUE(tree.tree().is_balanced());
    over += change.updated > kBudget && change.splits + change.merges > 1 ? 1 : 0;
    waited += change.wanting > 0 ? 1 : 0;
  }
  EXPECT_EQ(over, 0);
  EXPECT_GT(waited, 0);
  const Octree aim = aim_at(8);
  int frames = 0;
  while (!(tree.tree().drawn() == aim.drawn()) && frames < 100) {
    tree.step(aim, kBudget);
    ++frames;
  }
  EXPECT_GT(frames, 1);
  EXPECT_LT(frames, 100);
}

// The root alone, then its eight children: eight meshes, as the paper counts.
TEST(AmortisedTree, CountsAsThePaperDoes) {
  AmortisedTree tree{glm::ivec3(32)};
  Octree aim{glm::ivec3(32)};
  EXPECT_EQ(tree.step(aim, 0).updated, 0);
  aim.divide(aim.root());
  const TreeChange split = tree.step(aim, 40);
  EXPECT_EQ(split.splits, 1);
  EXPECT_EQ(split.updated, 8);
  const TreeChange merge = tree.step(Octree(glm::ivec3(32)), 40);
  EXPECT_EQ(merge.merges, 1);
  EXPECT_EQ(merge.updated, 1);
}

// Of eight children the lower four have a mesh: four are made. Where none has one the tree follows
// at once, whatever the budget.
TEST(AmortisedTree, CountsNoMeshOfANodeWithoutASurface) {
  AmortisedTree half(glm::ivec3(32),
                     [](const Node& node, const Surroundings&) { return node.at.z == 0; });
  Octree aim{glm::ivec3(32)};
  aim.divide(aim.root());
  half.step(Octree{glm::ivec3(32)}, 0);
  EXPECT_EQ(half.step(aim, 40).updated, 4);
  AmortisedTree none(kSize, [](const Node&, const Surroundings&) { return false; });
  const TreeChange change = none.step(aim_at(0), 1);
  EXPECT_EQ(none.tree().drawn(), aim_at(0).drawn());
  EXPECT_GT(change.splits, 1);
  EXPECT_EQ(change.updated, 0);
}

}  // namespace
}  // namespace plumb::mesh::stacks
