// Distances between the surfaces of nodes.
#include "mesh/stacks/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {
namespace {

constexpr Corners kTriangle{glm::dvec3{0, 0, 0}, glm::dvec3{4, 0, 0}, glm::dvec3{0, 4, 0}};

TEST(SquaredDistance, IsToTheInsideAnEdgeOrACorner) {
  EXPECT_EQ(squared_distance({1, 1, 3}, kTriangle), 9.0);
  EXPECT_EQ(squared_distance({2, -3, 0}, kTriangle), 9.0);
  EXPECT_EQ(squared_distance({-2, 1, 0}, kTriangle), 4.0);
  EXPECT_EQ(squared_distance({3, 3, 0}, kTriangle), 2.0);  // (2, 2, 0) is nearest
  EXPECT_EQ(squared_distance({-3, -4, 0}, kTriangle), 25.0);
  EXPECT_EQ(squared_distance({7, 0, 4}, kTriangle), 25.0);
  EXPECT_EQ(squared_distance({0, 9, 0}, kTriangle), 25.0);
}

TEST(SquaredDistance, IsToAnEdgeOrAPointWhereATriangleHasNoArea) {
  const glm::dvec3 o(0), x(4, 0, 0), middle(1, 0, 0);
  for (const Corners& edge : {Corners{o, x, x}, Corners{o, o, x}, Corners{o, x, o},
                              Corners{o, x, middle}, Corners{middle, x, o}}) {
    EXPECT_EQ(squared_distance({2, 3, 0}, edge), 9.0);
    EXPECT_EQ(squared_distance({7, 4, 0}, edge), 25.0);
  }
  EXPECT_EQ(squared_distance({3, 4, 0}, Corners{o, o, o}), 25.0);
}

// A ground of 16 x 16 squares of a metre at some heights.
template <class Height>
std::vector<Corners> ground(const Height& height) {
  std::vector<Corners> triangles;
  const auto at = [&](int x, int y) { return glm::dvec3(x, y, height(x, y)); };
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return triangles;
}

TEST(DistanceBound, OfLevelGroundThreeMetresAboveIsThree) {
  const TriangleTree below(ground([](int, int) { return 0.0; }));
  const std::vector<Corners> above{
      {glm::dvec3{2, 2, 3}, glm::dvec3{13, 3, 3}, glm::dvec3{5, 14, 3}}};
  const double bound_m = distance_bound(above, below, 0.0);
  EXPECT_GE(bound_m, 3.0);
  EXPECT_LE(bound_m, 3.3);
  EXPECT_EQ(distance_of_middles(above, below), 3.0);
}

TEST(DistanceBound, IsInfiniteWhereThereIsNothing) {
  const std::vector<Corners> one{kTriangle};
  EXPECT_TRUE(std::isinf(distance_bound(one, TriangleTree(), 0.0)));
  EXPECT_TRUE(std::isinf(rough_distance_bound(one, TriangleTree())));
  EXPECT_TRUE(std::isinf(distance_of_middles(one, TriangleTree())));
  EXPECT_EQ(distance_bound({}, TriangleTree(), 0.0), 0.0);
}

// Every point of a coarse ground against a rough one: none beyond the bound, which is within a
// tenth of the farthest but for the few metres / 64 between points that are looked at.
TEST(DistanceBound, HoldsForAllPointsAndIsWithinATenth) {
  const TriangleTree rough(
      ground([](int x, int y) { return 0.25 * ((x * 7 + y * 5 + x * y) % 11); }));
  const std::vector<Corners> coarse{
      {glm::dvec3{1, 1, 1}, glm::dvec3{15, 2, 2}, glm::dvec3{3, 15, 0}}};
  const auto& [a, b, c] = coarse[0];
  double farthest = 0.0;
  for (int i = 0; i <= 200; ++i) {
    for (int j = 0; i + j <= 200; ++j) {
      NearestTriangle nearest;
      rough.look_for(a + i / 200.0 * (b - a) + j / 200.0 * (c - a), nearest);
      farthest = std::max(farthest, std::sqrt(nearest.squared));
    }
  }
  const double bound_m = distance_bound(coarse, rough, 0.0);
  EXPECT_GE(bound_m, farthest);
  EXPECT_LE(bound_m, 1.1 * farthest + 0.1);
  EXPECT_LE(distance_of_middles(coarse, rough), bound_m);
  EXPECT_GE(rough_distance_bound(coarse, rough), bound_m);
}

}  // namespace
}  // namespace plumb::mesh::stacks
