#include "raster/rasteriser.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/raster/window_mesh.h"

namespace plumb::raster {
namespace {

using test::coverage;
using test::window_camera;
using test::window_mesh;

std::string covered(int width, int height, std::initializer_list<test::WindowPoint> points) {
  return coverage(rasterise(window_mesh(points), window_camera(width, height)).image);
}

// A pixel's centre on the left or top side belongs to the square, on the right or bottom side not.
TEST(FillRule, KeepsLeftAndTopAndLeavesRightAndBottom) {
  EXPECT_EQ(covered(4, 4, {{0.5, 0.5}, {2.5, 0.5}, {0.5, 2.5}, {2.5, 0.5}, {2.5, 2.5}, {0.5, 2.5}}),
            "##..\n"
            "##..\n"
            "....\n"
            "....\n");
}

// Centres with x + y = 3 (pixel numbers) lie on the slanted edge: a right edge of the upper
// triangle, a left edge of the lower one.
TEST(FillRule, GivesASharedSlantToTheTriangleOnItsRight) {
  EXPECT_EQ(covered(4, 4, {{0, 0}, {4, 0}, {0, 4}}),
            "###.\n"
            "##..\n"
            "#...\n"
            "....\n");
  EXPECT_EQ(covered(4, 4, {{4, 0}, {4, 4}, {0, 4}}),
            "...#\n"
            "..##\n"
            ".###\n"
            "####\n");
}

TEST(FillRule, IsTheSameWhicheverWayTheCornersRun) {
  for (int turn = 0; turn < 3; ++turn) {
    const test::WindowPoint p[3] = {{0.5, 0.5}, {3.5, 0.5}, {0.5, 3.5}};
    const auto clockwise = covered(4, 4, {p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]});
    EXPECT_EQ(clockwise, covered(4, 4, {p[turn], p[(turn + 2) % 3], p[(turn + 1) % 3]}));
    EXPECT_EQ(clockwise, "###.\n##..\n#...\n....\n");
  }
}

TEST(Snapping, RoundsToTheNearestOf256SubpixelsAndHalvesUp) {
  EXPECT_EQ(snap(1.0), 256);
  EXPECT_EQ(snap(1.0 + 0.25 / 256), 256);
  EXPECT_EQ(snap(1.0 + 0.5 / 256), 257);
  EXPECT_EQ(snap(-1.0 - 0.5 / 256), -256);
  EXPECT_EQ(snap(-1.0 - 0.75 / 256), -257);
  EXPECT_EQ(snap(1e300), kLargestCoordinate);
  EXPECT_EQ(snap(-1e300), -kLargestCoordinate);
}

// A left side at 0.5 + 1/1024 px snaps to the centre and keeps the pixel; half a subpixel does not.
TEST(Snapping, DecidesWhetherAnEdgeBesideACentreCoversIt) {
  EXPECT_EQ(covered(2, 1, {{0.5 + 1.0 / 1024, -4}, {9, -4}, {0.5 + 1.0 / 1024, 9}}), "##\n");
  EXPECT_EQ(covered(2, 1, {{0.5 + 1.0 / 512, -4}, {9, -4}, {0.5 + 1.0 / 512, 9}}), ".#\n");
}

// Screen half way between depths 1 and 3: 1/w is the mean of 1 and 1/3, so w = 1.5, and the point
// is 3/4 of the near corner and 1/4 of the far one.
TEST(Rasteriser, InterpolatesInPerspective) {
  const TriangleMesh mesh = window_mesh({{0.5, 0.5, 1.0}, {4.5, 0.5, 3.0}, {0.5, 4.5, 1.0}});
  const HitImage image = rasterise(mesh, window_camera(5, 5)).image;
  const std::size_t pixel = image.index(2, 0);
  EXPECT_DOUBLE_EQ(image.depth_m[pixel], 1.5);
  EXPECT_DOUBLE_EQ(image.from_eye_m[pixel].x, 0.75 * 0.5 + 0.25 * 13.5);
  EXPECT_DOUBLE_EQ(image.from_eye_m[pixel].y, 1.5);
  EXPECT_DOUBLE_EQ(image.from_eye_m[pixel].z, -0.75);
  EXPECT_EQ(image.depth_m[image.index(0, 0)], 1.0);  // at the corner itself, exactly
  EXPECT_EQ(image.primitive[pixel], 0u);
}

TEST(Rasteriser, KeepsTheNearestAndCountsTheOthers) {
  const TriangleMesh mesh = window_mesh({{0, 0, 2},
                                         {2, 0, 2},
                                         {0, 2, 2},  //
                                         {0, 0, 1},
                                         {2, 0, 1},
                                         {0, 2, 1},  //
                                         {0, 0, 3},
                                         {2, 0, 3},
                                         {0, 2, 3}});
  const RasterResult result = rasterise(mesh, window_camera(2, 2));
  EXPECT_EQ(coverage(result.image), "#.\n..\n");
  EXPECT_EQ(result.image.primitive[0], 1u);
  EXPECT_EQ(result.image.depth_m[0], 1.0);
  EXPECT_EQ(result.image.overdraw[0], 3);
  EXPECT_EQ(result.image.overdraw[1], 0);
  EXPECT_EQ(result.fragments, 3);
  EXPECT_EQ(result.image.primitive[1], kNoPrimitive);
  EXPECT_EQ(result.image.depth_m[1], kNoHit);
}

TEST(Rasteriser, GivesATieToTheLowestIndexWhereverTheChunksEnd) {
  const TriangleMesh mesh = window_mesh({{0, 0},
                                         {9, 0},
                                         {0, 9},
                                         {0, 0},
                                         {9, 0},
                                         {0, 9},  //
                                         {0, 0},
                                         {9, 0},
                                         {0, 9}});
  for (const int chunk : {1, 2, 3}) {
    const HitImage image = rasterise(mesh, window_camera(3, 3), {.chunk_triangles = chunk}).image;
    for (const std::uint32_t primitive : image.primitive) EXPECT_EQ(primitive, 0u);
    for (const std::uint16_t overdraw : image.overdraw) EXPECT_EQ(overdraw, 3);
  }
}

TEST(Rasteriser, CountsOverdrawUpToItsLargestNumberAndFragmentsBeyond) {
  TriangleMesh mesh = window_mesh({{0, 0}, {9, 0}, {0, 9}});
  mesh.triangles.assign(70000, mesh.triangles[0]);
  const RasterResult result = rasterise(mesh, window_camera(1, 1));
  EXPECT_EQ(result.image.overdraw[0], 65535);
  EXPECT_EQ(result.fragments, 70000);
}

TEST(Rasteriser, DropsFragmentsBeyondFarOneByOne) {
  Camera camera = window_camera(8, 1);
  camera.far_m = 2.0;  // 1/w falls linearly from 1 at x = 0 to 1/3 at x = 8: 1/2 at x = 6
  const TriangleMesh mesh = window_mesh({{0, -8, 1},
                                         {8, -8, 3},
                                         {0, 8, 1},  //
                                         {8, -8, 3},
                                         {8, 8, 3},
                                         {0, 8, 1}});
  const RasterResult result = rasterise(mesh, camera);
  EXPECT_EQ(coverage(result.image), "######..\n");
  EXPECT_EQ(result.fragments, 6);
}

TEST(Rasteriser, DropsTrianglesWithoutArea) {
  EXPECT_EQ(covered(3, 1, {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}}), "...\n");  // a line
  EXPECT_EQ(covered(3, 1, {{0.5, 0.5}, {0.5, 0.5}, {2.5, 0.5}}), "...\n");  // two corners
  EXPECT_EQ(covered(3, 1, {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}), "...\n");  // a point
  // No area once snapped.
  EXPECT_EQ(covered(3, 1, {{0.5, 0.5}, {2.5, 0.5}, {0.5, 0.5 + 1e-4}}), "...\n");
}

TEST(Rasteriser, DrawsASliverExactly) {
  // One subpixel high at its left end, with its top side through the centres.
  EXPECT_EQ(covered(4, 1, {{0.5, 0.5}, {3.5, 0.5}, {0.5, 0.5 + 1.0 / 256}}), "###.\n");
}

TEST(Rasteriser, DrawsOnePixelImages) {
  EXPECT_EQ(covered(1, 1, {{0, 0}, {2, 0}, {0, 2}}), "#\n");
  EXPECT_EQ(covered(1, 1, {{0.75, 0}, {2, 0}, {0.75, 2}}), ".\n");
}

TEST(Rasteriser, DrawsOneSideWhenAsked) {
  const TriangleMesh clockwise = window_mesh({{0, 0}, {2, 0}, {0, 2}});
  const Camera camera = window_camera(1, 1);
  EXPECT_EQ(rasterise(clockwise, camera, {.facing = Facing::Both}).fragments, 1);
  EXPECT_EQ(rasterise(clockwise, camera, {.facing = Facing::Clockwise}).fragments, 1);
  EXPECT_EQ(rasterise(clockwise, camera, {.facing = Facing::CounterClockwise}).fragments, 0);
}

// A terrain's triangles run counter-clockwise seen from above, and so they do on the screen.
TEST(Rasteriser, SeesACounterClockwiseTriangleFromAboveAsCounterClockwise) {
  TriangleMesh mesh;
  mesh.vertices_m = {{-90, -90, 0}, {90, -90, 0}, {0, 90, 0}};
  mesh.triangles = {{0, 1, 2}};
  const Camera above =
      make_camera({.eye_m = {0, 0, 10}, .target_m = {0, 0, 0}, .width_px = 3, .height_px = 3});
  EXPECT_EQ(rasterise(mesh, above, {.facing = Facing::CounterClockwise}).fragments, 9);
  EXPECT_EQ(rasterise(mesh, above, {.facing = Facing::Clockwise}).fragments, 0);
}

TEST(FragmentStage, DecidesWhichFragmentsExist) {
  const TriangleMesh mesh = window_mesh({{0, 0, 1},
                                         {8, 0, 1},
                                         {0, 8, 1},  //
                                         {0, 0, 2},
                                         {8, 0, 2},
                                         {0, 8, 2}});
  // The near triangle exists in even columns only; the far one shows through the others.
  const auto keep = [](const Fragment& f) { return f.primitive == 1 || f.x % 2 == 0; };
  const RasterResult result = rasterise(mesh, window_camera(3, 1), {}, keep);
  EXPECT_EQ(result.image.primitive, (std::vector<std::uint32_t>{0, 1, 0}));
  EXPECT_EQ(result.image.overdraw, (std::vector<std::uint16_t>{2, 1, 2}));
  EXPECT_EQ(result.fragments, 5);
}

TEST(FragmentStage, SeesThePointAndTheDepthThatTheImageGets) {
  const TriangleMesh mesh = window_mesh({{0, 0, 1}, {8, 0, 5}, {0, 8, 2}});
  const HitImage plain = rasterise(mesh, window_camera(4, 4)).image;
  const auto keep = [&](const Fragment& f) {
    const std::size_t pixel = plain.index(f.x, f.y);
    return f.depth_m == plain.depth_m[pixel] && f.from_eye_m == plain.from_eye_m[pixel];
  };
  const RasterResult result = rasterise(mesh, window_camera(4, 4), {}, keep);
  EXPECT_EQ(test::checksum(result.image), test::checksum(plain));
  EXPECT_EQ(result.fragments, 16);
}

TEST(Rasteriser, RefusesWhatItCannotDraw) {
  const Camera camera = window_camera(2, 2);
  TriangleMesh mesh = window_mesh({{0, 0}, {2, 0}, {0, 2}});
  EXPECT_THROW(rasterise(mesh, camera, {.tile_px = 0}), std::invalid_argument);
  EXPECT_THROW(rasterise(mesh, camera, {.chunk_triangles = -1}), std::invalid_argument);
  Camera bad = camera;
  bad.width_px = 0;
  EXPECT_THROW(rasterise(mesh, bad), std::invalid_argument);
  bad = camera;
  bad.near_m = 0.0;
  EXPECT_THROW(rasterise(mesh, bad), std::invalid_argument);
  bad = camera;
  bad.gamma_v = NAN;
  EXPECT_THROW(rasterise(mesh, bad), std::invalid_argument);
  bad = camera;
  bad.centre_px.x = 1e6;
  EXPECT_THROW(rasterise(mesh, bad), std::invalid_argument);
  mesh.triangles.push_back({0, 1, 3});
  EXPECT_THROW(rasterise(mesh, camera), std::invalid_argument);
  mesh = window_mesh({{0, 0}, {2, 0}, {0, NAN}});
  EXPECT_THROW(rasterise(mesh, camera), std::invalid_argument);
}

TEST(Rasteriser, DrawsNothingOfAnEmptyMesh) {
  const RasterResult result = rasterise(TriangleMesh{}, window_camera(2, 2));
  EXPECT_EQ(coverage(result.image), "..\n..\n");
  EXPECT_EQ(result.fragments, 0);
}

}  // namespace
}  // namespace plumb::raster
