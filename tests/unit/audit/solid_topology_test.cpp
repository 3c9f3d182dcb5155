// What hangs together wrongly, planted.
#include "audit/solid_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "audit/self_intersections.h"
#include "core/parallel.h"
#include "solid_scenes.h"
#include "support/test_meshes.h"

namespace plumb::audit {
namespace {

Topology topology(TriangleMesh mesh) {
  const terrain::Heightfield field = level_ground();
  const MeshTruth truth = truth_of(field);
  const DrawnSurface surface = with_mesh(truth.surface(), std::move(mesh));
  return solid_topology_of(truth, surface, MeshEdges(*surface.mesh), 20);
}

// The outline's sides are 16 m long; what ends there is no flaw, a metre inside it is.
TEST(SolidTopology, ExpectsTheSurfaceToEndAtTheOutlineAlone) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 4}, {16, 0, 4}, {16, 16, 4}, {0, 16, 4}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(topology(mesh).boundary_edges, 4);
  EXPECT_EQ(topology(mesh).open_edges, 0);
  for (const std::size_t k : {1u, 2u}) mesh.vertices_m[k].x = 15;
  EXPECT_EQ(topology(mesh).open_edges, 1);
}

// Two triangles over one edge, the third corner of one lifted by an angle: normals are 180 degrees
// minus that apart.
TriangleMesh hinged(double angle_rad) {
  TriangleMesh mesh;
  mesh.vertices_m = {
      {0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, std::cos(angle_rad), std::sin(angle_rad)}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  return mesh;
}

TEST(SolidTopology, CallsFoldedWhatTurnsByMoreThan150Degrees) {
  constexpr double kDegree = 0.017453292519943295;
  EXPECT_EQ(topology(hinged(29.0 * kDegree)).folded_triangles, 1);
  EXPECT_EQ(topology(hinged(31.0 * kDegree)).folded_triangles, 0);
  EXPECT_EQ(topology(hinged(180.0 * kDegree)).folded_triangles, 0);
}

TEST(SolidTopology, FindsATJunctionInSpace) {
  TriangleMesh mesh;
  mesh.vertices_m = {{1, 1, 0}, {1, 1, 2}, {3, 1, 1}, {1, 1, 1}, {1, 3, 0}, {1, 3, 2}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 4}, {3, 1, 5}};
  EXPECT_EQ(topology(mesh).t_junctions, 1);  // vertex 3, within the upright edge from 0 to 1
  mesh.vertices_m[3].y = 1.5;
  EXPECT_EQ(topology(mesh).t_junctions, 0);
}

// An upright triangle through a level one.
TriangleMesh crossing(double lowest_m) {
  TriangleMesh mesh;
  mesh.vertices_m = {
      {0, 0, 0},           {4, 0, 0}, {0, 4, 0}, {1, 1, lowest_m}, {1.5, 1, lowest_m + 2},
      {1, 1, lowest_m + 2}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

TEST(SelfIntersections, AreCountedWhereTrianglesPassThroughEachOther) {
  EXPECT_EQ(self_intersections_of(crossing(-1.0)), 1);
  EXPECT_EQ(self_intersections_of(crossing(0.5)), 0);
  EXPECT_EQ(self_intersections_of(crossing(0.0)), 0);  // touches with a corner
}

TEST(SelfIntersections, AreNoneOfASphereAndMeetWithAnotherOne) {
  TriangleMesh mesh = test_support::sphere_mesh(10.0, 3);
  EXPECT_EQ(self_intersections_of(mesh), 0);
  const TriangleMesh other = test_support::sphere_mesh(10.0, 3);
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const glm::dvec3& v : other.vertices_m) mesh.vertices_m.push_back(v + glm::dvec3(3, 2, 1));
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  std::int64_t slow = 0;
  for (std::size_t a = 0; a < mesh.triangles.size(); ++a) {
    for (std::size_t b = a + 1; b < mesh.triangles.size(); ++b) {
      if (a >= other.triangles.size() || b < other.triangles.size()) continue;
      TriangleMesh pair;
      for (const std::size_t t : {a, b}) {
        const auto at = static_cast<std::uint32_t>(pair.vertices_m.size());
        for (const std::uint32_t v : mesh.triangles[t])
          pair.vertices_m.push_back(mesh.vertices_m[v]);
        pair.triangles.push_back({at, at + 1, at + 2});
      }
      slow += self_intersections_of(pair);
    }
  }
  EXPECT_GT(slow, 50);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(self_intersections_of(mesh), slow) << threads;
  }
}

}  // namespace
}  // namespace plumb::audit
