#include "reference/mesh_nearest.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

#include "core/parallel.h"
#include "reference/triangle_distance.h"
#include "support/random_scene.h"
#include "support/test_meshes.h"

namespace plumb::reference {
namespace {

using test_support::Random;

// Two triangles of a square, and one above it.
TriangleMesh square() {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 8}, {4, 0, 8}, {0, 4, 8}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
  return mesh;
}

NearestPoint by_trying_all(const TriangleMesh& mesh, const glm::dvec3& point) {
  NearestPoint best;
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& t = mesh.triangles[k];
    const glm::dvec3 apart =
        nearest_on_triangle(glm::dvec3(0.0), mesh.vertices_m[t[0]] - point,
                            mesh.vertices_m[t[1]] - point, mesh.vertices_m[t[2]] - point);
    const double distance = std::sqrt(glm::dot(apart, apart));
    if (distance < best.distance_m) best = {point + apart, distance, k};
  }
  return best;
}

TEST(MeshNearest, FindsPointDistanceAndTriangle) {
  const TriangleMesh mesh = square();
  const MeshNearest nearest(mesh);
  const NearestPoint below = nearest.nearest({3.0, 1.0, 2.0});
  EXPECT_EQ(below.point_m, glm::dvec3(3.0, 1.0, 0.0));
  EXPECT_EQ(below.distance_m, 2.0);
  EXPECT_EQ(below.triangle, 0u);
  EXPECT_EQ(nearest.nearest({1.0, 1.0, 7.0}).triangle, 2u);
}

// The diagonal belongs to both triangles of the square, as do its ends.
TEST(MeshNearest, NamesTheLowestOfEquallyNearTriangles) {
  const TriangleMesh mesh = square();
  const MeshNearest nearest(mesh);
  EXPECT_EQ(nearest.nearest({2.0, 2.0, 1.0}).triangle, 0u);
  EXPECT_EQ(nearest.nearest({-1.0, -1.0, -1.0}).triangle, 0u);
  EXPECT_EQ(nearest.nearest({-1.0, 5.0, 0.0}).triangle, 1u);
}

TEST(MeshNearest, LooksNoFartherThanTheRadius) {
  const TriangleMesh mesh = square();
  const MeshNearest nearest(mesh);
  EXPECT_FALSE(nearest.nearest({3.0, 1.0, 2.0}, 1.999));
  EXPECT_TRUE(nearest.nearest({3.0, 1.0, 2.0}, 2.0));
  EXPECT_TRUE(nearest.nearest({3.0, 1.0, 0.0}, 0.0));
}

TEST(MeshNearest, OfAMeshWithoutTrianglesIsNothing) {
  const TriangleMesh mesh;
  EXPECT_FALSE(MeshNearest(mesh).nearest({1.0, 2.0, 3.0}));
}

// Points that lie together, far apart, on the mesh, with and without a radius and a first guess:
// the walk that they share loses no triangle that one alone finds.
TEST(MeshNearest, GivesTogetherTheBitsOfEachAlone) {
  Random random(11);
  int found_ones = 0, crowded = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const terrain::Heightfield field = test_support::random_heightfield(random);
    const TriangleMesh mesh = test_support::mesh_of(field, terrain::Diagonal::Alternating);
    const MeshNearest nearest(mesh);
    const Box box = bounds(mesh);
    const glm::dvec3 size = box.high - box.low;
    for (int group = 0; group < 20; ++group) {
      const double spread = random.chance(0.3) ? 1.0 : 0.02;
      crowded += spread == 1.0 && mesh.triangles.size() > 128;
      const glm::dvec3 middle =
          box.low +
          size * glm::dvec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(-1, 2));
      std::vector<NearestQuery> queries(static_cast<std::size_t>(random.integer(1, 32)));
      for (NearestQuery& query : queries) {
        for (int axis = 0; axis < 3; ++axis) {
          query.point_m[axis] =
              middle[axis] + spread * std::max(1.0, size[axis]) * random.uniform(-1, 1);
        }
        if (random.chance(0.7)) query.max_radius_m = random.uniform(0, 0.1) * size.x;
        if (random.chance(0.5) && !mesh.triangles.empty())
          query.near_triangle = static_cast<std::uint32_t>(
              random.integer(0, static_cast<int>(mesh.triangles.size()) - 1));
      }
      std::vector<NearestPoint> together(queries.size());
      nearest.nearest_together(queries, together);
      for (std::size_t k = 0; k < queries.size(); ++k) {
        const NearestPoint alone = nearest.nearest(queries[k].point_m, queries[k].max_radius_m);
        ASSERT_EQ(together[k], alone);
        found_ones += static_cast<bool>(alone);
      }
    }
  }
  EXPECT_GT(found_ones, 1000);
  EXPECT_GT(crowded, 10);
}

TEST(MeshNearest, AgreesToTheBitWithTryingAllTriangles) {
  Random random(5);
  for (int scene = 0; scene < 40; ++scene) {
    const terrain::Heightfield field = test_support::random_heightfield(random);
    const TriangleMesh mesh = test_support::mesh_of(field, terrain::Diagonal::Alternating);
    const MeshNearest nearest(mesh);
    const glm::dvec3 size = bounds(mesh).high - bounds(mesh).low;
    for (int k = 0; k < 50; ++k) {
      const double reach = random.chance(0.2) ? 50.0 : 1.2;
      const glm::dvec3 point{size.x * random.uniform(-reach, reach),
                             size.y * random.uniform(-reach, reach),
                             size.z * random.uniform(-reach, reach)};
      ASSERT_EQ(nearest.nearest(point), by_trying_all(mesh, point)) << "scene " << scene;
      // Wherever the search begins.
      const auto count = static_cast<int>(mesh.triangles.size());
      const auto first = static_cast<std::uint32_t>(random.integer(0, count));
      ASSERT_EQ(nearest.nearest(point, 1e9, first), by_trying_all(mesh, point)) << first;
    }
  }
}

TEST(MeshNearest, OnASphereIsOffByNoMoreThanTheSagitta) {
  constexpr double kRadius = 100.0;
  const TriangleMesh mesh = test_support::sphere_mesh(kRadius, 5);
  const double sagitta = test_support::sagitta_m(mesh, kRadius);
  ASSERT_LT(sagitta, 0.1);
  const MeshNearest nearest(mesh);
  Random random(6);
  for (int k = 0; k < 2000; ++k) {
    const glm::dvec3 point{random.uniform(-300.0, 300.0), random.uniform(-300.0, 300.0),
                           random.uniform(-300.0, 300.0)};
    const double to_sphere = std::abs(glm::length(point) - kRadius);
    EXPECT_NEAR(nearest.nearest(point).distance_m, to_sphere, sagitta + 1e-12);
  }
}

TEST(MeshNearest, GivesTheSameBitsInBatchesOnAnyNumberOfThreads) {
  const TriangleMesh mesh = test_support::sphere_mesh(10.0, 4);
  const MeshNearest nearest(mesh);
  Random random(7);
  std::vector<glm::dvec3> points;
  for (int k = 0; k < 5000; ++k) {
    points.push_back({random.uniform(-20.0, 20.0), random.uniform(-20.0, 20.0), 3.0});
  }
  const std::vector<NearestPoint> many = nearest.nearest(points, 8.0);
  const ThreadLimit one(1);
  EXPECT_EQ(nearest.nearest(points, 8.0), many);
  EXPECT_EQ(nearest.nearest(points[17], 8.0), many[17]);
}

TEST(MeshNearest, RefusesWhatIsNoQuestion) {
  const TriangleMesh mesh = square();
  const MeshNearest nearest(mesh);
  EXPECT_THROW(nearest.nearest({std::nan(""), 0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(nearest.nearest({0.0, 0.0, 0.0}, -1.0), std::invalid_argument);
  const std::vector<NearestQuery> many(MeshNearest::kTogether + 1);
  std::vector<NearestPoint> found(many.size());
  EXPECT_THROW(nearest.nearest_together(many, found), std::invalid_argument);
  TriangleMesh broken = square();
  broken.triangles.push_back({0, 1, 7});
  EXPECT_THROW(MeshNearest{broken}, std::invalid_argument);
}

}  // namespace
}  // namespace plumb::reference
