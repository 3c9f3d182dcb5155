// What the conservative selection promises, against the nearest points of the finest surface.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>

#include "core/camera.h"
#include "core/parallel.h"
#include "mesh/stacks/selection.h"
#include "mesh/stacks/stacks.h"
#include "reference/mesh_nearest.h"
#include "terrain/camera_presets.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::mesh::stacks {
namespace {

Camera camera_at(const glm::dvec3& eye, const glm::dvec3& target) {
  LookAt look;
  look.eye_m = eye;
  look.target_m = target;
  look.width_px = 320;
  look.height_px = 180;
  return make_camera(look);
}

bool is_in_view(const Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 view = to_view(camera, point);
  if (!(view.z > camera.near_m)) return false;
  const glm::dvec2 pixel = view_to_pixel(camera, view);
  return pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= camera.width_px &&
         pixel.y <= camera.height_px;
}

double apart_on_screen(const Camera& camera, const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec2 d =
      view_to_pixel(camera, to_view(camera, p)) - view_to_pixel(camera, to_view(camera, q));
  return std::sqrt(d.x * d.x + d.y * d.y);
}

struct Worst {
  double px = 0.0;
  int points = 0;
};

// The corners and the middles of all triangles in view, against the nearest point of the other
// mesh.
Worst worst_between(const TriangleMesh& from, const TriangleMesh& to, const Camera& camera) {
  const reference::MeshNearest nearest(to);
  Worst worst;
  const auto ask = [&](const glm::dvec3& point) {
    if (!is_in_view(camera, point)) return;
    ++worst.points;
    worst.px = std::max(worst.px, apart_on_screen(camera, point, nearest.nearest(point).point_m));
  };
  for (const Triangle& t : from.triangles) {
    const glm::dvec3 &a = from.vertices_m[t[0]], &b = from.vertices_m[t[1]],
                     &c = from.vertices_m[t[2]];
    ask(a);
    ask((a + b + c) / 3.0);
  }
  return worst;
}

class AnyConservativeStacks : public testing::TestWithParam<int> {};

// Rounding of metres of some hundreds is far below a millionth of a pixel.
TEST_P(AnyConservativeStacks, LieWithinTheToleranceBothWays) {
  const int seed = GetParam();
  const Prepared prepared = prepare(terrain::generate_stacks(
      "generate:caves?size=80x64&relief=48&feature=120&seed=" + std::to_string(seed)));
  const DrawnSurface truth = finest(prepared);
  const Camera camera =
      camera_at({-60.0 - 40.0 * seed, 20.0 + 9.0 * seed, 120.0}, {40.0, 32.0, 20.0});
  std::size_t fewest = truth.mesh->triangles.size();
  for (const double tolerance_px : {2.0, 6.0, 20.0, 60.0}) {
    SCOPED_TRACE(tolerance_px);
    const DrawnSurface drawn = draw(prepared, camera, {tolerance_px, Unit::Pixel});
    const Worst forward = worst_between(*drawn.mesh, *truth.mesh, camera),
                reverse = worst_between(*truth.mesh, *drawn.mesh, camera);
    EXPECT_GT(forward.points, 100);
    EXPECT_LE(forward.px, tolerance_px + 1e-6);
    EXPECT_LE(reverse.px, tolerance_px + 1e-6);
    fewest = std::min(fewest, drawn.mesh->triangles.size());
  }
  EXPECT_LT(2 * fewest, truth.mesh->triangles.size());  // much coarser is drawn
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyConservativeStacks, testing::Values(1, 2, 3, 4, 5));

// Where nodes are beside coarser ones, what they draw is fitted to these: it is measured as it is
// drawn. As nodes among others of their level all are within 4 px here, drawn some are 4.23 px off.
TEST(ConservativeStacks, LieWithinTheToleranceWhereLevelsMeet) {
  const terrain::StackField field = terrain::generate_stacks("generate:caves?size=257");
  const Prepared prepared = prepare(field);
  const Camera camera =
      make_camera(terrain::preset_camera(terrain::top_surface(field), "oblique", 640, 360, 50.0));
  const DrawnSurface drawn = draw(prepared, camera, {4.0, Unit::Pixel}), truth = finest(prepared);
  EXPECT_LE(worst_between(*drawn.mesh, *truth.mesh, camera).px, 4.0 + 1e-6);
  EXPECT_LE(worst_between(*truth.mesh, *drawn.mesh, camera).px, 4.0 + 1e-6);
}

constexpr const char* kCaves = "generate:caves?size=80x64&relief=48&feature=120&seed=2";

void expect_same(const DrawnSurface& a, const DrawnSurface& b) {
  EXPECT_EQ(a.mesh->triangles, b.mesh->triangles);
  EXPECT_EQ(a.mesh->vertices_m, b.mesh->vertices_m);
  EXPECT_EQ(a.triangle_lod, b.triangle_lod);
}

// What is kept from one frame for the next saves work and changes nothing.
TEST(ConservativeFrames, AreTheSameWhateverWasDrawnBefore) {
  const terrain::StackField field = terrain::generate_stacks(kCaves);
  const Prepared used = prepare(field);
  const Camera one = camera_at({-60.0, 20.0, 120.0}, {40.0, 32.0, 20.0}),
               other = camera_at({90.0, 90.0, 40.0}, {40.0, 32.0, 20.0});
  for (const double tolerance_px : {20.0, 4.0})
    for (const Camera& camera : {other, one}) draw(used, camera, {tolerance_px, Unit::Pixel});
  for (const Camera& camera : {one, other}) {
    expect_same(draw(used, camera, {8.0, Unit::Pixel}),
                draw(prepare(field), camera, {8.0, Unit::Pixel}));
  }
}

TEST(ConservativeFrames, AreTheSameOnOneThreadAndFromSeveral) {
  const terrain::StackField field = terrain::generate_stacks(kCaves);
  const Camera one = camera_at({-60.0, 20.0, 120.0}, {40.0, 32.0, 20.0}),
               other = camera_at({90.0, 90.0, 40.0}, {40.0, 32.0, 20.0});
  const auto alone = [&](const Camera& camera) {
    const ThreadLimit limit(1);
    return draw(prepare(field), camera, {8.0, Unit::Pixel});
  };
  const DrawnSurface alone_one = alone(one), alone_other = alone(other);
  const Prepared shared = prepare(field);
  DrawnSurface at_once;
  std::thread thread([&] { at_once = draw(shared, one, {8.0, Unit::Pixel}); });
  const DrawnSurface beside = draw(shared, other, {8.0, Unit::Pixel});
  thread.join();
  expect_same(at_once, alone_one);
  expect_same(beside, alone_other);
}

// Nodes far from the picture are asked for nothing.
TEST(ConservativeFrames, MakeNoNodeFarOutOfView) {
  const Prepared prepared = prepare(terrain::generate_stacks("generate:caves?size=257x65"));
  draw(prepared, camera_at({20.0, -20.0, 40.0}, {20.0, 30.0, 30.0}), {2.0, Unit::Pixel});
  const std::size_t in_view = prepared.cache->bytes();
  finest(prepared);
  EXPECT_LT(2 * in_view, prepared.cache->bytes());
}

// 1 m at 100 m and 1000 px a unit: ten pixels in the middle of the picture, more towards its
// corner.
TEST(ApartPx, IsAtLeastWhatTheMiddleShowsAndInfiniteAroundTheEye) {
  Camera camera = camera_at({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  camera.gamma_h = camera.gamma_v = 1000.0;
  Box box;
  box.add({-1.0, 100.0, -1.0});
  box.add({1.0, 102.0, 1.0});
  const double apart = apart_px(camera, box, 1.0);
  EXPECT_GE(apart, 10.0);
  EXPECT_LT(apart, 11.0);  // tan of the corner's angle is 0.18: 1 + 0.034, and the nearer end
  EXPECT_EQ(apart_px(camera, box, 0.0), 0.0);
  EXPECT_TRUE(std::isinf(apart_px(camera, box, 100.0)));
}

// Half a unit off the middle a metre along the ray's circle is 1 + 1/4 times as long on the screen:
// 12.5 px at 100 m, and the box is 111.8 m away.
TEST(ApartPx, IsLargerOffTheMiddle) {
  Camera camera = camera_at({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  camera.gamma_h = camera.gamma_v = 1000.0;
  camera.width_px = 4000;
  camera.centre_px.x = 2000.0;
  Box middle, beside;
  middle.add({0.0, 100.0, 0.0});
  beside.add({50.0, 100.0, 0.0});
  EXPECT_NEAR(apart_px(camera, middle, 1.0), 10.0, 0.01);
  EXPECT_NEAR(apart_px(camera, beside, 1.0), 1250.0 / std::sqrt(12500.0), 0.1);
}

}  // namespace
}  // namespace plumb::mesh::stacks
