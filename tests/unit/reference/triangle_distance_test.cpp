#include "reference/triangle_distance.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

#include "support/random_scene.h"

namespace plumb::reference {
namespace {

using test_support::Random;

const glm::dvec3 kA{0.0, 0.0, 0.0}, kB{4.0, 0.0, 0.0}, kC{0.0, 4.0, 0.0};

TEST(NearestOnTriangle, IsTheFootAboveTheInside) {
  EXPECT_EQ(nearest_on_triangle({1.0, 1.0, 7.0}, kA, kB, kC), glm::dvec3(1.0, 1.0, 0.0));
  EXPECT_EQ(nearest_on_triangle({1.0, 2.0, -3.0}, kA, kB, kC), glm::dvec3(1.0, 2.0, 0.0));
}

TEST(NearestOnTriangle, IsOnAnEdgeBesideIt) {
  EXPECT_EQ(nearest_on_triangle({1.0, -2.0, 5.0}, kA, kB, kC), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(nearest_on_triangle({-1.0, 3.0, 0.0}, kA, kB, kC), glm::dvec3(0.0, 3.0, 0.0));
  EXPECT_EQ(nearest_on_triangle({4.0, 4.0, 1.0}, kA, kB, kC), glm::dvec3(2.0, 2.0, 0.0));
}

TEST(NearestOnTriangle, IsACornerBeyondIt) {
  EXPECT_EQ(nearest_on_triangle({-1.0, -1.0, 2.0}, kA, kB, kC), kA);
  EXPECT_EQ(nearest_on_triangle({9.0, 1.0, 0.0}, kA, kB, kC), kB);
  EXPECT_EQ(nearest_on_triangle({1.0, 9.0, 0.0}, kA, kB, kC), kC);
}

TEST(NearestOnTriangle, WithoutAreaIsItsEdges) {
  const glm::dvec3 middle{2.0, 0.0, 0.0};
  EXPECT_EQ(nearest_on_triangle({3.0, 1.0, 0.0}, kA, kB, middle), glm::dvec3(3.0, 0.0, 0.0));
  EXPECT_EQ(nearest_on_triangle({9.0, 1.0, 0.0}, kA, middle, kB), kB);
  EXPECT_EQ(nearest_on_triangle({9.0, 1.0, 0.0}, kB, kB, kB), kB);
}

TEST(NearestOnTriangle, GivesTheSameBitsForBothTrianglesOfAnEdge) {
  Random random(1);
  const auto point = [&] {
    return glm::dvec3{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0),
                      random.uniform(-9.0, 9.0)};
  };
  for (int k = 0; k < 1000; ++k) {
    const glm::dvec3 p = point(), a = point(), b = point();
    ASSERT_EQ(nearest_on_segment(p, a, b), nearest_on_segment(p, b, a));
  }
}

// Least distance over a fine net of points of the triangle: an upper bound that the answer must not
// exceed, and by no more than the net's half diagonal may it lie below.
TEST(NearestOnTriangle, IsNearerThanEveryOtherPoint) {
  Random random(2);
  constexpr int kNet = 60;
  for (int k = 0; k < 300; ++k) {
    const auto coordinate = [&] { return random.uniform(-1.0, 1.0); };
    const double thin = random.chance(0.3) ? 1e-9 : 1.0;
    const glm::dvec3 p{coordinate(), coordinate(), coordinate()};
    const glm::dvec3 a{coordinate(), coordinate(), coordinate()};
    const glm::dvec3 b = a + glm::dvec3{coordinate(), coordinate(), coordinate()};
    const glm::dvec3 c = a + random.uniform(-0.5, 1.5) * (b - a) +
                         thin * glm::dvec3{coordinate(), coordinate(), coordinate()};
    const double found = glm::distance(p, nearest_on_triangle(p, a, b, c));
    double least = 1e9;
    for (int v = 0; v <= kNet; ++v) {
      for (int w = 0; v + w <= kNet; ++w) {
        const glm::dvec3 q = a + (static_cast<double>(v) / kNet) * (b - a) +
                             (static_cast<double>(w) / kNet) * (c - a);
        least = std::min(least, glm::distance(p, q));
      }
    }
    const double net = (glm::distance(a, b) + glm::distance(a, c)) / kNet;
    EXPECT_LE(found, least * (1.0 + 1e-14) + 1e-15);
    EXPECT_GE(found, least - net);
  }
}

}  // namespace
}  // namespace plumb::reference
