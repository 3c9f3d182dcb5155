#include "mesh/restricted_quadtree/bintree.h"

#include <gtest/gtest.h>

namespace plumb::mesh::restricted_quadtree {
namespace {

int twice_area(const BinTriangle& t) {
  return (t.b.i - t.a.i) * (t.c.j - t.a.j) - (t.b.j - t.a.j) * (t.c.i - t.a.i);
}

TEST(Bintree, ChildrenAreTheHalvesInTheOrderOfTheFormat) {
  const BinTriangle root{{0, 0}, {4, 4}, {0, 4}};
  const auto [first, second] = children(root);
  EXPECT_EQ(first, (BinTriangle{{0, 4}, {0, 0}, {2, 2}}));
  EXPECT_EQ(second, (BinTriangle{{4, 4}, {0, 4}, {2, 2}}));
}

// Walks the whole tree: each triangle is found again from its base vertex and side alone.
void expect_found_again(const BinTriangle& t, int& finest) {
  EXPECT_GT(twice_area(t), 0) << "clockwise";
  if (is_finest(t)) {
    ++finest;
    return;
  }
  EXPECT_EQ(triangle_of_base(base_vertex(t), side_of_base(t)), t);
  for (const BinTriangle& child : children(t)) {
    EXPECT_EQ(twice_area(child) * 2, twice_area(t));
    EXPECT_EQ(level_above_finest(child) + 1, level_above_finest(t));
    expect_found_again(child, finest);
  }
}

TEST(Bintree, EveryTriangleIsThatOfItsBaseVertexAndSide) {
  int finest = 0;
  for (const BinTriangle& root : root_triangles(32)) expect_found_again(root, finest);
  EXPECT_EQ(finest, 2 * 32 * 32);  // two halves of each cell
}

// The finest triangles are those of the alternating diagonals: both ends have an even sum.
void expect_alternating(const BinTriangle& t) {
  if (!is_finest(t)) {
    for (const BinTriangle& child : children(t)) expect_alternating(child);
    return;
  }
  EXPECT_EQ((t.a.i + t.a.j) % 2, 0);
  EXPECT_EQ((t.b.i + t.b.j) % 2, 0);
}

TEST(Bintree, EndsInTheAlternatingPattern) {
  for (const int side : {2, 4, 8, 16}) {
    for (const BinTriangle& root : root_triangles(side)) expect_alternating(root);
  }
}

}  // namespace
}  // namespace plumb::mesh::restricted_quadtree
