// Past which rims, and through what thickness of rock, a surface within a tolerance lets a ray
// pass: level ground from y = 0 to 8, and a plate, met at places whose distances are known.
#include "audit/mesh_band_walk.h"

#include <gtest/gtest.h>

#include <limits>

#include "audit/solid_coverage.h"
#include "solid_scenes.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// 500 pixels to a tangent of one: a pixel is 4 cm wide at 20 m.
Camera from(const glm::dvec3& eye_m) {
  LookAt look;
  look.eye_m = eye_m;
  look.target_m = eye_m + glm::dvec3(0.0, 1.0, 0.0);
  look.width_px = 200;
  look.height_px = 1000;
  look.fov_y_deg = 90.0;
  look.near_m = 0.01;
  return make_camera(look);
}

TriangleMesh ground(double z_m = 4.0) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, z_m}, {16, 0, z_m}, {16, 8, z_m}, {0, 8, z_m}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// Upright, from y = 8 to 8.2, closed on all sides.
TriangleMesh plate() {
  TriangleMesh mesh;
  for (const double z : {0.0, 10.0}) {
    for (const double y : {8.0, 8.2}) {
      for (const double x : {0.0, 40.0}) mesh.vertices_m.push_back({x, y, z});
    }
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

bool may_pass(const TriangleMesh& mesh, const glm::dvec3& eye_m, const glm::dvec3& met_m,
              double band_m, double far_m = kInfinity) {
  const terrain::Heightfield field = level_ground();
  const MeshTruth truth(field, with_mesh(full_detail(field), mesh));
  Camera camera = from(eye_m);
  camera.far_m = far_m;
  return MeshBandWalk(truth, camera, {1.0, band_m}).may_pass(met_m - eye_m);
}

// From 10 m before the ground and 2 m above it, the ray that meets it at y = 7 comes below its end
// at y = 8 by 2 m * 1 / 17 = 0.1176 m, the one that meets it at y = 4 by 0.571 m.
TEST(MeshBandWalk, SunkGroundLetsARayPassItsRim) {
  const glm::dvec3 eye{8.0, -10.0, 6.0};
  EXPECT_TRUE(may_pass(ground(), eye, {8, 7, 4}, 0.12));
  EXPECT_FALSE(may_pass(ground(), eye, {8, 7, 4}, 0.115));
  EXPECT_TRUE(may_pass(ground(), eye, {8, 4, 4}, 0.58));
  EXPECT_FALSE(may_pass(ground(), eye, {8, 4, 4}, 0.56));
}

// It has not come below the band yet where it ends: at y = 7.9 by 2 m * 0.9 / 17 = 0.106 m.
TEST(MeshBandWalk, SunkGroundLetsARayRunOnToTheFarPlane) {
  const glm::dvec3 eye{8.0, -10.0, 6.0};
  EXPECT_TRUE(may_pass(ground(), eye, {8, 7, 4}, 0.11, 17.9));
  EXPECT_FALSE(may_pass(ground(), eye, {8, 7, 4}, 0.10, 17.9));
}

// From 2 m before the ground and half a metre above it, the ray that meets it at y = 0.5 came over
// its rim at 0.5 m * 0.5 / 2.5 = 0.1 m.
TEST(MeshBandWalk, RaisedGroundLetsARaySlipBelowItsRim) {
  const glm::dvec3 eye{8.0, -2.0, 4.5};
  EXPECT_TRUE(may_pass(ground(), eye, {8, 0.5, 4}, 0.11));
  EXPECT_FALSE(may_pass(ground(), eye, {8, 0.5, 4}, 0.09));
}

// Straight down there is no end of rock.
TEST(MeshBandWalk, NoRayPassesStraightDown) {
  LookAt look;
  look.eye_m = {8.0, 4.0, 20.0};
  look.target_m = {8.0, 4.0, 0.0};
  const terrain::Heightfield field = level_ground();
  const MeshTruth truth(field, with_mesh(full_detail(field), ground()));
  EXPECT_FALSE(MeshBandWalk(truth, make_camera(look), {1.0, 1.0}).may_pass({0, 0, -16}));
}

// At 45 degrees; half its thickness is 0.1 m, and the far side's pixel is not the near side's.
TEST(MeshBandWalk, AThinPlateMayVanish) {
  const glm::dvec3 eye{2.0, 0.0, 5.0}, met{10.0, 8.0, 5.0};
  EXPECT_TRUE(may_pass(plate(), eye, met, 0.11));
  EXPECT_FALSE(may_pass(plate(), eye, met, 0.09));
}

TEST(MeshBandWalk, KeepsWhatIsNoFartherThanTheBand) {
  const terrain::Heightfield field = level_ground();
  const MeshTruth truth(field, with_mesh(full_detail(field), ground()));
  const glm::dvec3 eye{8.0, -10.0, 4.0};
  const MeshBandWalk walk(truth, from(eye), {1.0, 0.2});
  EXPECT_TRUE(walk.keeps(glm::dvec3(8.0, 4.0, 4.19) - eye));
  EXPECT_FALSE(walk.keeps(glm::dvec3(8.0, 4.0, 4.21) - eye));
  EXPECT_TRUE(walk.keeps(glm::dvec3(8.0, 8.19, 4.0) - eye));
  EXPECT_FALSE(walk.keeps(glm::dvec3(8.0, 8.5, 4.3) - eye));
}

// The ground with a slope behind it: a gap between y = 8 and 12, through which no ray from the eye
// gets, as it would have to come lower than 3.5 m there.
TriangleMesh ground_before_a_slope(double ground_m) {
  TriangleMesh mesh = ground(ground_m);
  mesh.vertices_m.insert(mesh.vertices_m.end(),
                         {{-40, 12, 3.5}, {60, 12, 3.5}, {60, 20, 60}, {-40, 20, 60}});
  mesh.triangles.insert(mesh.triangles.end(), {{4, 5, 6}, {4, 6, 7}});
  return mesh;
}

Coverage coverage_of_lowered(double by_m, double band_m) {
  const terrain::Heightfield field = level_ground();
  const DrawnSurface any = full_detail(field);
  const MeshTruth truth(field, with_mesh(any, ground_before_a_slope(4.0)));
  AuditOptions options;
  options.band.metres = band_m;
  return audit_surface(truth, with_mesh(any, ground_before_a_slope(4.0 - by_m)),
                       from({8.0, -10.0, 6.0}), options)
      .coverage;
}

// From y = 5.65 on the ground lets rays pass below its old place; below 3.5 m they slip under the
// slope, from y = 7.6 on they meet it. Rows 57.0 to 63.9, and 200 pixels a row.
TEST(MeshBandWalk, ARimThatSinksWithinTheToleranceLeavesNoHole) {
  EXPECT_EQ(coverage_of_lowered(0.3, 0.31).holes, 0);
  const std::int64_t holes = coverage_of_lowered(0.3, 0.2).holes;
  EXPECT_GE(holes, 6 * 200);
  EXPECT_LE(holes, 7 * 200);
}

}  // namespace
}  // namespace plumb::audit
