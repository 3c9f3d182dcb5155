#include "reference/ray_triangle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/random_scene.h"

namespace plumb::reference {
namespace {

using test_support::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double meet(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const RayFrame frame(ray);
  const glm::dvec3& o = ray.origin_m;
  return meet_triangle(frame.place(a - o), frame.place(b - o), frame.place(c - o), ray.t_min,
                       ray.t_max);
}

const glm::dvec3 kA{0.0, 0.0, 0.0}, kB{4.0, 0.0, 0.0}, kC{0.0, 4.0, 0.0};

TEST(MeetTriangle, GivesTheParameterOfTheRayFromBothSides) {
  EXPECT_EQ(meet({{1.0, 1.0, 8.0}, {0.0, 0.0, -2.0}}, kA, kB, kC), 4.0);
  EXPECT_EQ(meet({{1.0, 1.0, -8.0}, {0.0, 0.0, 2.0}}, kA, kB, kC), 4.0);
  EXPECT_EQ(meet({{3.0, 1.0, 8.0}, {-1.0, 0.0, -4.0}}, kA, kB, kC), 2.0);
}

TEST(MeetTriangle, MissesBesideBehindAndBeyondTheRange) {
  EXPECT_EQ(meet({{3.0, 3.0, 8.0}, {0.0, 0.0, -1.0}}, kA, kB, kC), kInfinity);
  EXPECT_EQ(meet({{1.0, 1.0, 8.0}, {0.0, 0.0, 1.0}}, kA, kB, kC), kInfinity);
  EXPECT_EQ(meet({{1.0, 1.0, 8.0}, {0.0, 0.0, -1.0}, 0.0, 7.9}, kA, kB, kC), kInfinity);
  EXPECT_EQ(meet({{1.0, 1.0, 8.0}, {0.0, 0.0, -1.0}, 8.0, 8.0}, kA, kB, kC), 8.0);
}

TEST(MeetTriangle, HoldsItsEdgesAndCorners) {
  EXPECT_EQ(meet({{2.0, 2.0, 3.0}, {0.0, 0.0, -1.0}}, kA, kB, kC), 3.0);
  EXPECT_EQ(meet({{2.0, 0.0, 3.0}, {0.0, 0.0, -1.0}}, kA, kB, kC), 3.0);
  EXPECT_EQ(meet({{4.0, 0.0, 3.0}, {0.0, 0.0, -1.0}}, kA, kB, kC), 3.0);
}

TEST(MeetTriangle, SeenEdgeOnIsMetWhereTheRayEntersIt) {
  EXPECT_EQ(meet({{-5.0, 1.0, 0.0}, {1.0, 0.0, 0.0}}, kA, kB, kC), 5.0);
  EXPECT_EQ(meet({{-5.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, kA, kB, kC), 5.0);        // along an edge
  EXPECT_EQ(meet({{1.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, 0.25}, kA, kB, kC), 0.25);  // begins within
  EXPECT_EQ(meet({{-5.0, 5.0, 0.0}, {1.0, 0.0, 0.0}}, kA, kB, kC), kInfinity);
  EXPECT_EQ(meet({{-5.0, 1.0, 1.0}, {1.0, 0.0, 0.0}}, kA, kB, kC), kInfinity);
}

TEST(MeetTriangle, OfAVoidCornerIsMissed) {
  const glm::dvec3 none{0.0, 4.0, std::nan("")};
  for (const glm::dvec3& direction :
       {glm::dvec3{0.1, 0.1, -1.0}, {-1.0, 0.1, -0.5}, {0.1, -1.0, -0.5}}) {
    const Ray ray{glm::dvec3{1.0, 1.0, 0.0} - direction * 3.0, direction};
    EXPECT_NE(meet(ray, kA, kB, kC), kInfinity);
    EXPECT_EQ(meet(ray, kA, kB, none), kInfinity);
    EXPECT_EQ(meet(ray, none, kA, kB), kInfinity);
  }
}

// A fan of triangles round a point, seen from above (the fan is flatter than any ray, so no fold
// hides a part of it), and rays aimed at its spokes and its hub: some triangle is met by each.
TEST(MeetTriangle, LeavesNoGapBetweenNeighbours) {
  Random random(1);
  constexpr int kSpokes = 7;
  for (int k = 0; k < 20000; ++k) {
    const glm::dvec3 hub{random.uniform(-2e4, 2e4), random.uniform(-2e4, 2e4), 0.0};
    std::array<glm::dvec3, kSpokes> rim;
    for (int s = 0; s < kSpokes; ++s) {
      const double angle = 6.283185307179586 * s / kSpokes;
      rim[static_cast<std::size_t>(s)] =
          hub + glm::dvec3{40.0 * std::cos(angle), 40.0 * std::sin(angle), random.uniform(-1, 1)};
    }
    const int spoke = random.integer(0, kSpokes - 1);
    const double along = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.9);
    const glm::dvec3 target = hub + along * (rim[static_cast<std::size_t>(spoke)] - hub);
    Ray ray;
    ray.origin_m = {random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0), 9e3};
    ray.direction = (target - ray.origin_m) * random.uniform(1e-5, 1e-3);
    double first = kInfinity;
    for (std::size_t s = 0; s < kSpokes; ++s) {
      first = std::min(first, meet(ray, hub, rim[s], rim[(s + 1) % kSpokes]));
    }
    ASSERT_NE(first, kInfinity) << k;
  }
}

// A ray through a third of an edge, whose parameter no division gives exactly.
TEST(MeetTriangle, GivesBothTrianglesOfAnEdgeTheSameParameter) {
  Random random(3);
  for (int k = 0; k < 2000; ++k) {
    const glm::dvec3 a{0.0, 0.0, random.uniform(-9.0, 9.0)}, b{3.0, 0.0, random.uniform(-9.0, 9.0)};
    const glm::dvec3 c{1.0, 5.0, random.uniform(-9.0, 9.0)},
        d{2.0, -4.0, random.uniform(-9.0, 9.0)};
    const Ray ray{{1.0, 0.0, 20.0}, {0.0, 0.0, -1.0}};
    const double t = meet(ray, a, b, c);
    ASSERT_NE(t, kInfinity);
    ASSERT_EQ(t, meet(ray, b, a, d)) << k;
  }
}

TEST(MeetTriangle, IsAsExactAsTheCoordinates) {
  Random random(2);
  for (int k = 0; k < 20000; ++k) {
    const auto corner = [&] {
      return glm::dvec3{random.uniform(-50.0, 50.0), 5000.0 + random.uniform(-50.0, 50.0),
                        random.uniform(-50.0, 50.0)};
    };
    const glm::dvec3 a = corner(), b = corner(), c = corner();
    const double v = random.uniform(0.1, 0.4), w = random.uniform(0.1, 0.4);
    const glm::dvec3 target = a + v * (b - a) + w * (c - a);
    const glm::dvec3 u = b - a, q = c - a;
    const glm::dvec3 normal{u.y * q.z - u.z * q.y, u.z * q.x - u.x * q.z, u.x * q.y - u.y * q.x};
    const double length = std::sqrt(glm::dot(normal, normal) * glm::dot(target, target));
    const double sine = std::abs(glm::dot(normal, target)) / length;
    if (sine < 1e-3) continue;
    // Points are rounded at 2^-53 of 5000 m, some ten times; a plane at a slant lengthens that.
    const double bound = 10.0 * 0x1p-53 / sine;
    ASSERT_NEAR(meet({glm::dvec3(0.0), target}, a, b, c), 1.0, bound * 8.0) << k;
  }
}

}  // namespace
}  // namespace plumb::reference
