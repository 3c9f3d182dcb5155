// Pieces of a block put together are what the tessellator draws.
#include "mesh/tessellation/block_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesh/tessellation/tessellator.h"
#include "support/random_scene.h"

namespace plumb::mesh::tessellation {
namespace {

using test_support::Random;
using Triangles = std::multiset<BlockTriangle>;

// The same triangle, its least corner first.
BlockTriangle turned(BlockTriangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Triangles pieces_of(const BlockPieces& pieces, const BlockLevels& levels) {
  Triangles triangles;
  pieces.for_each_piece(levels, [&](const std::vector<BlockTriangle>& piece) {
    for (const BlockTriangle& t : piece) triangles.insert(turned(t));
  });
  return triangles;
}

Triangles tessellated(int cells, const BlockLevels& levels) {
  Factors factors{};
  for (std::size_t k = 0; k < 4; ++k)
    factors.outer[k] = static_cast<float>(cells >> levels.side[k]);
  factors.inner.fill(static_cast<float>(cells >> levels.inside));
  const Tessellation drawn = tessellate(Spacing::Integer, factors);
  const std::uint32_t cell = 65536u / static_cast<std::uint32_t>(cells);
  Triangles triangles;
  for (const auto& t : drawn.triangles) {
    BlockTriangle corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const DomainPoint& p = drawn.points[t[k]];
      EXPECT_EQ(p.u % cell + p.v % cell, 0u) << "a vertex off the samples";
      corners[k] = {static_cast<std::uint8_t>(p.u / cell), static_cast<std::uint8_t>(p.v / cell)};
    }
    triangles.insert(turned(corners));
  }
  return triangles;
}

// Counter-clockwise is positive.
int twice_area(const Triangles& triangles) {
  int sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += (b.i - a.i) * (c.j - a.j) - (c.i - a.i) * (b.j - a.j);
  return sum;
}

BlockLevels uniform(std::uint8_t level) { return {level, {level, level, level, level}}; }

TEST(BlockPieces, AreTheTessellatorsTrianglesForEveryCombinationOfLevels) {
  const BlockPieces pieces(8);
  ASSERT_EQ(pieces.coarsest(), 3);
  for (unsigned k = 0; k < 1024; ++k) {
    const auto level = [&](unsigned n) { return static_cast<std::uint8_t>(k >> 2 * n & 3u); };
    const BlockLevels levels{level(0), {level(1), level(2), level(3), level(4)}};
    const Triangles triangles = pieces_of(pieces, levels);
    EXPECT_EQ(triangles, tessellated(8, levels)) << k;
    EXPECT_EQ(twice_area(triangles), 2 * 64) << k;
  }
}

TEST(BlockPieces, OfLargerBlocksAreTheTessellatorsToo) {
  Random random(31);
  for (const int cells : {16, 32, 64}) {
    const BlockPieces pieces(cells);
    const auto level = [&] {
      return static_cast<std::uint8_t>(random.integer(0, pieces.coarsest()));
    };
    for (int k = 0; k < 150; ++k) {
      const BlockLevels levels{level(), {level(), level(), level(), level()}};
      const Triangles triangles = pieces_of(pieces, levels);
      EXPECT_EQ(triangles, tessellated(cells, levels)) << cells;
      EXPECT_EQ(twice_area(triangles), 2 * cells * cells);
    }
  }
}

// The inner ring of a block thinned by two, the rim's four sides at full detail: a strip has its
// own side's eight segments, and two of the ring's.
TEST(BlockPieces, AStripHangsOnNothingButTheInsideAndItsSide) {
  const BlockPieces pieces(8);
  EXPECT_EQ(pieces.strip(1, South, 0).size(), 8u + 2u);
  for (const BlockTriangle& t : pieces.strip(1, South, 0)) {
    for (const BlockPoint& p : t) EXPECT_LE(p.j, 2);
  }
  Random random(32);
  const auto level = [&] { return static_cast<std::uint8_t>(random.integer(0, 3)); };
  for (int k = 0; k < 400; ++k) {
    const auto side = static_cast<std::size_t>(random.integer(0, 3));
    BlockLevels a{static_cast<std::uint8_t>(random.integer(0, 2)),
                  {level(), level(), level(), level()}};
    BlockLevels b{a.inside, {level(), level(), level(), level()}};
    b.side[side] = a.side[side];
    const Triangles in_a = tessellated(8, a), in_b = tessellated(8, b);
    for (const BlockTriangle& t : pieces.strip(a.inside, side, a.side[side])) {
      EXPECT_EQ(in_a.count(turned(t)), 1u);
      EXPECT_EQ(in_b.count(turned(t)), 1u);
    }
  }
}

TEST(BlockPieces, OfSmallFactorsCanBeCountedByHand) {
  const BlockPieces pieces(8);
  EXPECT_EQ(pieces_of(pieces, uniform(0)).size(), 128u);  // two a cell
  EXPECT_EQ(pieces_of(pieces, uniform(2)).size(), 8u);    // a fan around the centre
  EXPECT_TRUE(pieces.interior(2).empty());
  EXPECT_EQ(pieces_of(pieces, uniform(3)).size(), 2u);
  // Inside 1 beside another factor is 2: the fan, one side of which has eight segments.
  EXPECT_EQ(pieces_of(pieces, {3, {3, 3, 3, 0}}).size(), 3u + 8u);
}

TEST(BlockPieces, RefuseBlocksThatNoEdgeCanBeCutInto) {
  for (const int cells : {-8, 0, 4, 12, 128})
    EXPECT_THROW(BlockPieces{cells}, std::invalid_argument);
}

}  // namespace
}  // namespace plumb::mesh::tessellation
