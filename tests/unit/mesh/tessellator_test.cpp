// The tessellator on patches that can be drawn by hand.
#include "mesh/tessellation/tessellator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumb::mesh::tessellation {
namespace {

using Points = std::vector<DomainPoint>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kHalf = 32768, kOne = 65536;

Factors all(float factor) { return {{factor, factor, factor, factor}, {factor, factor}}; }

bool same(const Tessellation& a, const Tessellation& b) {
  return a.points == b.points && a.triangles == b.triangles;
}

// v along the edge u = 0 of a patch whose factors are all alike, from (0, 1) down to (0, 0).
std::vector<std::uint32_t> edge_of(Spacing spacing, float factor) {
  std::vector<std::uint32_t> places;
  for (const DomainPoint& point : tessellate(spacing, all(factor)).points) {
    if (point.u != 0) break;
    places.push_back(point.v);
  }
  return places;
}

TEST(Tessellator, LeavesASquareOfFactorsOneAsTwoTriangles) {
  for (const Spacing spacing : {Spacing::Integer, Spacing::PowerOfTwo, Spacing::FractionalOdd}) {
    const Tessellation t = tessellate(spacing, all(1.0f));
    EXPECT_EQ(t.points, (Points{{0, 0}, {kOne, 0}, {kOne, kOne}, {0, kOne}}));
    EXPECT_EQ(t.triangles, (Triangles{{0, 1, 3}, {1, 2, 3}}));
  }
}

// The rim from (0, 1) counter-clockwise, then the centre with a fan around it.
TEST(Tessellator, MakesAFanOfEightOfFactorsTwo) {
  for (const Spacing spacing : {Spacing::Integer, Spacing::PowerOfTwo, Spacing::FractionalEven}) {
    const Tessellation t = tessellate(spacing, all(2.0f));
    EXPECT_EQ(t.points, (Points{{0, kOne},
                                {0, kHalf},
                                {0, 0},
                                {kHalf, 0},
                                {kOne, 0},
                                {kOne, kHalf},
                                {kOne, kOne},
                                {kHalf, kOne},
                                {kHalf, kHalf}}));
    EXPECT_EQ(t.triangles, (Triangles{{0, 1, 8},
                                      {1, 2, 8},
                                      {2, 3, 8},
                                      {3, 4, 8},
                                      {4, 5, 8},
                                      {5, 6, 8},
                                      {6, 7, 8},
                                      {7, 0, 8}}));
  }
}

TEST(Tessellator, GivesAnInsideOfOneACentreWhereAnEdgeIsDivided) {
  const Tessellation t = tessellate(Spacing::Integer, {{2.0f, 1.0f, 1.0f, 1.0f}, {1.0f, 1.0f}});
  EXPECT_EQ(t.points,
            (Points{{0, kOne}, {0, kHalf}, {0, 0}, {kOne, 0}, {kOne, kOne}, {kHalf, kHalf}}));
  EXPECT_EQ(t.triangles, (Triangles{{0, 1, 5}, {1, 2, 5}, {5, 2, 3}, {5, 3, 4}, {5, 4, 0}}));
}

// 65536 / 3 = 21845.33, and from the other end 65536 - 21845 = 43691.
TEST(Tessellator, CutsFactorsThreeIntoThirdsAroundASquare) {
  for (const Spacing spacing : {Spacing::Integer, Spacing::FractionalOdd}) {
    const Tessellation t = tessellate(spacing, all(3.0f));
    EXPECT_EQ(edge_of(spacing, 3.0f), (std::vector<std::uint32_t>{kOne, 43691, 21845, 0}));
    ASSERT_EQ(t.points.size(), 16u);
    EXPECT_EQ(Points(t.points.begin() + 12, t.points.end()),
              (Points{{21845, 43691}, {21845, 21845}, {43691, 21845}, {43691, 43691}}));
    ASSERT_EQ(t.triangles.size(), 18u);
    EXPECT_EQ(Triangles(t.triangles.begin(), t.triangles.begin() + 4),
              (Triangles{{0, 1, 12}, {12, 1, 13}, {13, 1, 2}, {2, 3, 13}}));
    EXPECT_EQ(Triangles(t.triangles.end() - 2, t.triangles.end()),
              (Triangles{{12, 14, 15}, {12, 13, 14}}));
  }
}

// Half way from two segments to four, and from one to three.
TEST(Tessellator, MovesPointsFromOneNumberOfSegmentsToTheNextAsAFactorGrows) {
  EXPECT_EQ(edge_of(Spacing::FractionalEven, 3.0f),
            (std::vector<std::uint32_t>{kOne, 40960, kHalf, 24576, 0}));
  EXPECT_EQ(edge_of(Spacing::FractionalOdd, 2.0f),
            (std::vector<std::uint32_t>{kOne, 54613, 10923, 0}));
  // A quarter of the way from six to eight: (3/4)/6 + (1/4)/8 = 0.15625, which is 10240 / 65536,
  // and a short one beside the middle. 1/6 as 10923 / 65536 makes the second and third one more.
  EXPECT_EQ(edge_of(Spacing::FractionalEven, 6.5f),
            (std::vector<std::uint32_t>{kOne, 55296, 45055, 34815, kHalf, 30721, 20481, 10240, 0}));
}

// 15 thirtieths as 15 * 2185 are 7 too many, where the new segment begins beside the middle.
TEST(Tessellator, RunsBackAtTheMiddleJustAboveThirtyAsTheReferenceDoes) {
  const std::vector<std::uint32_t> edge = edge_of(Spacing::FractionalEven, 30.0f + 0x1p-15f);
  ASSERT_EQ(edge.size(), 33u);
  EXPECT_EQ(edge[15], kHalf - 7);
  EXPECT_EQ(edge[16], kHalf);
  EXPECT_EQ(edge[17], kHalf + 7);
}

TEST(Tessellator, CullsPatchesWithAnEdgeThatIsNotPositive) {
  for (const Spacing spacing :
       {Spacing::Integer, Spacing::PowerOfTwo, Spacing::FractionalOdd, Spacing::FractionalEven}) {
    for (std::size_t edge = 0; edge < 4; ++edge) {
      for (const float factor : {0.0f, -0.0f, -1.0f, kNan, -kInfinity}) {
        Factors factors = all(5.0f);
        factors.outer[edge] = factor;
        Tessellation t = tessellate(spacing, all(4.0f));
        tessellate(spacing, factors, t);
        EXPECT_TRUE(t.points.empty() && t.triangles.empty()) << factor;
      }
    }
  }
}

TEST(Tessellator, TakesTheLowestFactorForAnInsideThatIsNotPositive) {
  for (const float factor : {0.0f, -3.0f, kNan, -kInfinity}) {
    EXPECT_TRUE(same(tessellate(Spacing::Integer, {{3, 3, 3, 3}, {factor, 5}}),
                     tessellate(Spacing::Integer, {{3, 3, 3, 3}, {1, 5}})));
    EXPECT_TRUE(same(tessellate(Spacing::FractionalEven, {{3, 3, 3, 3}, {5, factor}}),
                     tessellate(Spacing::FractionalEven, {{3, 3, 3, 3}, {5, 2}})));
  }
}

TEST(Tessellator, ClampsFactorsToTheRangeOfTheirSpacing) {
  for (const float factor : {65.0f, 1e30f, kInfinity}) {
    EXPECT_TRUE(
        same(tessellate(Spacing::Integer, all(factor)), tessellate(Spacing::Integer, all(64))));
    EXPECT_TRUE(
        same(tessellate(Spacing::PowerOfTwo, all(factor)), tessellate(Spacing::Integer, all(64))));
    EXPECT_TRUE(same(tessellate(Spacing::FractionalEven, all(factor)),
                     tessellate(Spacing::FractionalEven, all(64))));
    EXPECT_TRUE(same(tessellate(Spacing::FractionalOdd, all(factor)),
                     tessellate(Spacing::FractionalOdd, all(63))));
  }
  EXPECT_TRUE(same(tessellate(Spacing::Integer, all(0.25f)), tessellate(Spacing::Integer, all(1))));
  EXPECT_TRUE(same(tessellate(Spacing::FractionalOdd, all(0.25f)),
                   tessellate(Spacing::FractionalOdd, all(1))));
  EXPECT_TRUE(same(tessellate(Spacing::FractionalEven, all(0.25f)),
                   tessellate(Spacing::FractionalEven, all(2))));
}

// (64 + 1)^2 points and 2 * 64^2 triangles; (63 + 1)^2 and 2 * 63^2.
TEST(Tessellator, HasAsManyPointsAndTrianglesAsAGrid) {
  EXPECT_EQ(tessellate(Spacing::Integer, all(64)).points.size(), 4225u);
  EXPECT_EQ(tessellate(Spacing::Integer, all(64)).triangles.size(), 8192u);
  EXPECT_EQ(tessellate(Spacing::FractionalOdd, all(64)).points.size(), 4096u);
  EXPECT_EQ(tessellate(Spacing::FractionalOdd, all(64)).triangles.size(), 7938u);
}

TEST(Tessellator, RoundsWholeFactorsUp) {
  const float above_one = std::nextafter(1.0f, 2.0f);
  EXPECT_TRUE(
      same(tessellate(Spacing::Integer, all(above_one)), tessellate(Spacing::Integer, all(2))));
  EXPECT_TRUE(
      same(tessellate(Spacing::Integer, all(62.5f)), tessellate(Spacing::Integer, all(63))));
  EXPECT_TRUE(
      same(tessellate(Spacing::PowerOfTwo, all(2.5f)), tessellate(Spacing::Integer, all(4))));
  EXPECT_TRUE(
      same(tessellate(Spacing::PowerOfTwo, all(33)), tessellate(Spacing::Integer, all(64))));
}

// A fractional factor becomes a multiple of 2^-16: half of one above 1 is still 1, and so is not
// divided; more is 1 + 2^-16, three segments whose outer two have no length yet. Of the 18
// triangles two cover the square.
TEST(Tessellator, FramesASquareOnceAFactorExceedsOneByMoreThanHalfAStep) {
  Factors factors = all(1.0f);
  factors.outer[2] = 1.0f + 0x1p-17f;
  EXPECT_EQ(tessellate(Spacing::FractionalOdd, factors).triangles.size(), 2u);
  const Tessellation t = tessellate(Spacing::FractionalOdd, all(1.0f + 0x1p-16f));
  ASSERT_EQ(t.triangles.size(), 18u);
  int with_area = 0;
  for (const auto& [a, b, c] : t.triangles) {
    const bool corners_differ = !(t.points[a] == t.points[b]) && !(t.points[b] == t.points[c]) &&
                                !(t.points[c] == t.points[a]);
    with_area += corners_differ ? 1 : 0;
  }
  EXPECT_EQ(with_area, 2);
}

// FNV-1a over all numbers, in order.
std::uint64_t checksum(const Tessellation& t) {
  std::uint64_t sum = 14695981039346656037u;
  const auto add = [&](std::uint32_t number) { sum = (sum ^ number) * 1099511628211u; };
  for (const DomainPoint& point : t.points) {
    add(point.u);
    add(point.v);
  }
  for (const auto& triangle : t.triangles) {
    for (const std::uint32_t corner : triangle) add(corner);
  }
  return sum;
}

// Taken when these were Mesa's, bit for bit, as tests/gpu sees to.
TEST(Tessellator, GivesTheSameAsEver) {
  const Factors mixed{{64.0f, 1.5f, 17.25f, 33.0f}, {13.7f, 41.0f}};
  EXPECT_EQ(checksum(tessellate(Spacing::Integer, all(64))), 1086976354028829453u);
  EXPECT_EQ(checksum(tessellate(Spacing::Integer, mixed)), 14571351532636987126u);
  EXPECT_EQ(checksum(tessellate(Spacing::PowerOfTwo, mixed)), 10241317445685555785u);
  EXPECT_EQ(checksum(tessellate(Spacing::FractionalOdd, mixed)), 2368105935035082159u);
  EXPECT_EQ(checksum(tessellate(Spacing::FractionalEven, mixed)), 14993081336350735295u);
}

}  // namespace
}  // namespace plumb::mesh::tessellation
