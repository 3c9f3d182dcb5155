// The octree over a field: what exists, what is drawn, what lies beside it.
#include "mesh/stacks/octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "core/hash.h"

namespace plumb::mesh::stacks {
namespace {

// 40 x 17 x 1 voxels: 3 x 2 x 1 nodes, 2 x 1 x 1 of the next level, and one that holds all.
Octree flat() { return Octree({40, 17, 1}); }

Octree flat_divided() {
  Octree octree = flat();
  octree.divide([](const Node&) { return true; });
  return octree;
}

// 64^3 voxels; of the eight nodes of level 1 the first is divided.
Octree two_levels() {
  Octree octree{glm::ivec3(64)};
  octree.divide(octree.root());
  octree.divide(Node{1, glm::ivec3(0)});
  return octree;
}

TEST(Octree, HalvesSizesAndRoundsUp) {
  EXPECT_EQ(flat().root_level(), 2);
  EXPECT_EQ(flat().size(0), glm::ivec3(40, 17, 1));
  EXPECT_EQ(flat().size(1), glm::ivec3(20, 9, 1));
  EXPECT_EQ(flat().size(2), glm::ivec3(10, 5, 1));
}

TEST(Octree, IsOneNodeWhereSixteenVoxelsHoldAll) {
  EXPECT_EQ(Octree(glm::ivec3(16)).root_level(), 0);
  EXPECT_EQ(Octree(glm::ivec3(1, 17, 1)).root_level(), 1);
  EXPECT_EQ(Octree(glm::ivec3(1, 1 << 24, 1)).root_level(), 20);
}

TEST(Octree, RefusesSizesThatAreNone) {
  EXPECT_THROW(Octree({0, 1, 1}), std::invalid_argument);
  EXPECT_THROW(Octree({1, 1, (1 << 24) + 1}), std::invalid_argument);
}

TEST(Octree, HasNodesInsideWhereTheyHoldAVoxel) {
  const Octree octree = flat();
  EXPECT_TRUE(octree.is_inside({0, {2, 1, 0}}));
  EXPECT_FALSE(octree.is_inside({0, {3, 0, 0}}));
  EXPECT_FALSE(octree.is_inside({0, {0, 2, 0}}));
  EXPECT_FALSE(octree.is_inside({0, {0, 0, -1}}));
  EXPECT_TRUE(octree.is_inside({1, {1, 0, 0}}));
  EXPECT_FALSE(octree.is_inside({1, {0, 1, 0}}));
}

TEST(Octree, DrawsTheRootUntilItIsDivided) {
  Octree octree = flat();
  EXPECT_EQ(octree.drawn(), std::vector<Node>{octree.root()});
  octree.divide(octree.root());
  EXPECT_EQ(octree.drawn(), (std::vector<Node>{{1, {0, 0, 0}}, {1, {1, 0, 0}}}));
  EXPECT_FALSE(octree.is_drawn(octree.root()));
  EXPECT_TRUE(octree.is_drawn({1, {1, 0, 0}}));
  EXPECT_FALSE(octree.is_drawn({0, {0, 0, 0}}));
}

TEST(Octree, DividesNoFurtherThanTheFinestLevel) {
  EXPECT_EQ(flat_divided().drawn(), (std::vector<Node>{{0, {0, 0, 0}},
                                                       {0, {1, 0, 0}},
                                                       {0, {2, 0, 0}},
                                                       {0, {0, 1, 0}},
                                                       {0, {1, 1, 0}},
                                                       {0, {2, 1, 0}}}));
}

TEST(Octree, RefusesToDivideWhatIsNotDrawnOrIsFinest) {
  Octree octree = flat_divided();
  EXPECT_THROW(octree.divide(octree.root()), std::invalid_argument);
  EXPECT_THROW(octree.divide(Node{0, {0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(octree.divide(Node{1, {0, 1, 0}}), std::invalid_argument);
}

TEST(Octree, SeesWhatLiesBesideANode) {
  const Octree octree = two_levels();
  const Surroundings fine = octree.surroundings({0, {1, 0, 0}});
  EXPECT_EQ(fine[13], Beside::Same);
  EXPECT_EQ(fine[13 - 1], Beside::Same);
  EXPECT_EQ(fine[13 + 1], Beside::Coarser);
  EXPECT_EQ(fine[13 + 3], Beside::Same);
  EXPECT_EQ(fine[13 + 1 + 3 + 9], Beside::Coarser);
  EXPECT_EQ(fine[13 - 3], Beside::Outside);
  const Surroundings coarse = octree.surroundings({1, {1, 0, 0}});
  EXPECT_EQ(coarse[13 - 1], Beside::Finer);
  EXPECT_EQ(coarse[13 + 3], Beside::Same);
  EXPECT_EQ(coarse[13 + 1], Beside::Outside);
  EXPECT_EQ(octree.surroundings({1, {1, 1, 1}})[0], Beside::Finer);
}

TEST(Octree, IsBalancedUnlessNeighboursDifferByTwoLevels) {
  EXPECT_TRUE(two_levels().is_balanced());
  Octree octree{glm::ivec3(128)};
  octree.divide([](const Node& node) { return node.at == glm::ivec3(0) && node.level > 1; });
  EXPECT_TRUE(octree.is_balanced());
  octree.divide(Node{1, glm::ivec3(1)});  // it touches nodes of level 2 at its far corner
  EXPECT_FALSE(octree.is_balanced());
  octree.balance();
  EXPECT_TRUE(octree.is_balanced());
}

// The far corner of {1, (1, 1, 1)} is the middle of everything: seven nodes of level 2 are divided
// for it, and nothing else.
TEST(Octree, BalancesAcrossACorner) {
  Octree octree{glm::ivec3(128)};
  octree.divide([](const Node& node) { return node.at == glm::ivec3(0) && node.level > 1; });
  octree.divide(Node{1, glm::ivec3(1)});
  EXPECT_EQ(octree.drawn().size(), 8u + 7 + 7);
  octree.balance();
  EXPECT_EQ(octree.drawn().size(), 8u + 7 + 7 * 8);
}

// The voxels of a node on the finest level, its end included: what touches shares a place.
struct Span {
  glm::ivec3 low, high;
};
Span span_of(const Node& node) {
  const int side = kNodeVoxels << node.level;
  return {node.at * side, (node.at + 1) * side};
}

bool touch(const Node& a, const Node& b) {
  const Span s = span_of(a), t = span_of(b);
  for (int axis = 0; axis < 3; ++axis) {
    if (s.low[axis] > t.high[axis] || t.low[axis] > s.high[axis]) return false;
  }
  return true;
}

// One coarser node of two that touch and differ by more than one level, again and again.
void balance_slowly(Octree& octree) {
  for (bool again = true; again;) {
    again = false;
    const auto nodes = octree.drawn();
    for (std::size_t coarse = nodes.size(); coarse-- > 0 && !again;) {
      again = std::any_of(nodes.begin(), nodes.end(), [&](const Node& fine) {
        return fine.level + 1 < nodes[coarse].level && touch(fine, nodes[coarse]);
      });
      if (again) octree.divide(nodes[coarse]);
    }
  }
}

// Nodes are divided by chance, and those around one place down to the last.
Octree random_octree(std::uint64_t seed) {
  const auto draw = [&](int k, int least, int most) {
    const std::uint64_t bits = Checksum().add(seed).add(k).value() >> 16;
    return least + static_cast<int>(bits % static_cast<std::uint64_t>(most - least + 1));
  };
  Octree octree({draw(0, 100, 256), draw(1, 30, 200), draw(2, 10, 256)});
  glm::ivec3 place(0);
  for (int axis = 0; axis < 3; ++axis) place[axis] = draw(3 + axis, 0, octree.size(0)[axis] - 1);
  octree.divide([&](const Node& node) {
    const Span span = span_of(node);
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
      holds = holds && span.low[axis] <= place[axis] && place[axis] < span.high[axis];
    const auto& at = node.at;
    return holds ||
           Checksum().add(seed).add(node.level).add(at.x).add(at.y).add(at.z).value() % 8 == 0;
  });
  return octree;
}

TEST(Octree, IsBalancedByTheFewestDivisions) {
  int divided = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Octree octree = random_octree(seed), slow = octree;
    const std::size_t before = octree.drawn().size();
    octree.balance();
    balance_slowly(slow);
    EXPECT_EQ(octree.drawn(), slow.drawn()) << seed;
    EXPECT_TRUE(octree.is_balanced());
    divided += octree.drawn().size() > before ? 1 : 0;
  }
  EXPECT_GT(divided, 20);
}

TEST(Octree, DrawsEveryVoxelOnce) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Octree octree = random_octree(seed);
    octree.balance();
    std::int64_t voxels = 0;
    for (const Node& node : octree.drawn()) {
      const Span span = span_of(node);
      std::int64_t inside = 1;
      for (int axis = 0; axis < 3; ++axis)
        inside *= std::min(span.high[axis], octree.size(0)[axis]) - span.low[axis];
      EXPECT_GT(inside, 0);
      voxels += inside;
    }
    const glm::ivec3 size = octree.size(0);
    EXPECT_EQ(voxels, std::int64_t{size.x} * size.y * size.z);
  }
}

// Of the drawn nodes that hold a voxel beside a node; kept apart from how the tree does it.
Beside slow_beside(const Octree& octree, const std::vector<Node>& drawn, const Node& beside) {
  if (!octree.is_inside(beside)) return Beside::Outside;
  const glm::ivec3 voxel = span_of(beside).low;
  for (const Node& node : drawn) {
    const Span span = span_of(node);
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
      holds = holds && span.low[axis] <= voxel[axis] && voxel[axis] < span.high[axis];
    if (!holds) continue;
    return node.level == beside.level  ? Beside::Same
           : node.level < beside.level ? Beside::Finer
                                       : Beside::Coarser;
  }
  throw std::logic_error("no drawn node holds the voxel");
}

TEST(Octree, SeesBesideANodeWhatIsDrawnThere) {
  std::set<Beside> seen;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Octree octree = random_octree(seed);
    octree.balance();
    const auto drawn = octree.drawn();
    for (const Node& node : drawn) {
      const Surroundings around = octree.surroundings(node);
      for (int k = 0; k < 27; ++k) {
        const Node beside{node.level, node.at + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)};
        const Beside expected = slow_beside(octree, drawn, beside);
        ASSERT_EQ(around[static_cast<std::size_t>(k)], expected) << seed << " " << k;
        seen.insert(expected);
      }
    }
  }
  EXPECT_EQ(seen.size(), 4u);
}

}  // namespace
}  // namespace plumb::mesh::stacks
