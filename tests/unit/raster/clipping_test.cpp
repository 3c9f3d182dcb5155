#include <gtest/gtest.h>

#include <cmath>

#include "raster/rasteriser.h"
#include "unit/raster/window_mesh.h"

namespace plumb::raster {
namespace {

using test::coverage;
using test::window_camera;
using test::window_mesh;

Camera level_camera(const glm::dvec3& eye_m, int width_px = 64, int height_px = 64) {
  return make_camera({.eye_m = eye_m,
                      .target_m = eye_m + glm::dvec3(0, 1, 0),
                      .fov_y_deg = 90,
                      .width_px = width_px,
                      .height_px = height_px});
}

TriangleMesh ground_triangle(double reach_m) {
  TriangleMesh mesh;
  mesh.vertices_m = {{-reach_m, -reach_m, 0}, {reach_m, -reach_m, 0}, {0, reach_m, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// One triangle around, behind and before the eye fills exactly the lower half of a level view, and
// the depth in row y is the eye's height / tangent of the angle below the horizon.
TEST(Clipping, DrawsAHugeTriangleThroughTheEyesPlaneToTheHorizon) {
  const Camera camera = level_camera({0, 0, 2});
  const HitImage image = rasterise(ground_triangle(1e9), camera).image;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const std::size_t pixel = image.index(x, y);
      ASSERT_EQ(image.hit(pixel), y >= 32) << x << ", " << y;
      if (y < 32) continue;
      ASSERT_EQ(image.overdraw[pixel], 1);
      const double below_px = y + 0.5 - 32;
      const double expected_m = 2.0 * camera.gamma_v / below_px;
      // The corners' snapping moves the point by 1/512 px, which is a share of 1/512 / below_px;
      // twice that leaves room for second order in the row beside the horizon.
      EXPECT_NEAR(image.depth_m[pixel], expected_m, expected_m * 2.0 / 512 / below_px);
      // On the plane: three corners at height -2 relative to the eye, weights that add up to one
      // within a few roundings.
      EXPECT_NEAR(image.from_eye_m[pixel].z, -2.0, 1e-13);
    }
  }
}

// Nearer than near, a wall is not there; at near exactly it is.
TEST(Clipping, KeepsACornerExactlyOnTheNearPlane) {
  Camera camera = window_camera(3, 1);
  camera.near_m = 1.0;
  const double on = 1.0, before = std::nextafter(1.0, 0.0);
  EXPECT_EQ(coverage(rasterise(window_mesh({{0, -9, on}, {9, -9, on}, {0, 9, on}}), camera).image),
            "###\n");
  EXPECT_EQ(
      coverage(
          rasterise(window_mesh({{0, -9, before}, {9, -9, before}, {0, 9, before}}), camera).image),
      "...\n");
}

// A floor two units wide and from depth 0.5 to 1.5, one below the eye: near = 1 cuts it in the
// middle, so that it begins 1 * gamma / 1 below the centre.
TEST(Clipping, CutsATriangleAtTheNearPlane) {
  Camera camera = window_camera(1, 8);
  camera.near_m = 1.0;
  TriangleMesh mesh;  // seen at y_px = 4 / w: from 8 px (w = 0.5) up to 4 / 1.5 = 2.67 px
  mesh.vertices_m = {{-9, 0.5, -4}, {9, 0.5, -4}, {0.5, 1.5, -4}};
  mesh.triangles = {{0, 1, 2}};
  const HitImage image = rasterise(mesh, camera).image;
  EXPECT_EQ(coverage(image), ".\n.\n.\n#\n.\n.\n.\n.\n");  // 2.67 < 3.5 < 4: at w = 1 it ends
  EXPECT_NEAR(image.depth_m[3], 4 / 3.5, 4 / 3.5 * 2.0 / 512 / 3.5);
}

TEST(Clipping, LeavesOutWhatLiesBehindTheEye) {
  EXPECT_EQ(
      rasterise(window_mesh({{0, 0, -1}, {9, 0, -1}, {0, 9, -1}}), window_camera(4, 4)).fragments,
      0);
}

// 1e7 px wide, far outside the guard band of 2^20 px, cut at both sides; above the line y = 2 px.
TEST(Clipping, DrawsATriangleTenMillionPixelsWide) {
  const TriangleMesh mesh = window_mesh({{-5e6, 2}, {5e6, 2}, {0, -5e6}});
  const RasterResult result = rasterise(mesh, window_camera(4, 4));
  EXPECT_EQ(coverage(result.image), "####\n####\n....\n....\n");
  EXPECT_EQ(result.fragments, 8);
  for (const double depth_m : result.image.depth_m) {
    // Weights at a cut are ratios of lengths of 1e7 px to a pixel's: 1e7 roundings of 1e-16 each.
    if (depth_m < kNoHit) {
      EXPECT_NEAR(depth_m, 1.0, 1e-9);
    }
  }
}

// Two such triangles share a slant through the image: each pixel has one owner.
TEST(Clipping, CutsASharedEdgeAtTheSamePlaceForBoth) {
  const TriangleMesh mesh = window_mesh({{-3e6, -3.1e6},
                                         {4e6, 4.2e6},
                                         {-5e6, 6e6},  //
                                         {-3e6, -3.1e6},
                                         {5e6, -4e6},
                                         {4e6, 4.2e6}});
  const HitImage image = rasterise(mesh, window_camera(257, 257)).image;
  for (std::size_t pixel = 0; pixel < image.size(); ++pixel) ASSERT_EQ(image.overdraw[pixel], 1);
}

TEST(Clipping, GivesPiecesTheIndexOfTheirTriangle) {
  TriangleMesh mesh = ground_triangle(100);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 0});  // degenerate: index 0 never shows
  const HitImage image = rasterise(mesh, level_camera({0, 0, 2})).image;
  EXPECT_EQ(image.primitive[image.index(32, 63)], 1u);
}

// The picture of the same ground at UTM coordinates, eye included, is the same to the digits that
// the eye's own coordinates have: 4.5e6 has an ulp of 9.3e-10 m.
TEST(Rasteriser, KeepsItsDigitsInUtmCoordinates) {
  const glm::dvec3 utm{500000.3, 4500000.7, 0.0};
  TriangleMesh near_mesh = ground_triangle(1000), far_mesh = near_mesh;
  far_mesh.origin_m = utm;
  Camera near_camera = level_camera({3, 5, 2}), far_camera = near_camera;
  far_camera.eye_m += utm;
  const HitImage a = rasterise(near_mesh, near_camera).image;
  const HitImage b = rasterise(far_mesh, far_camera).image;
  int compared = 0;
  for (std::size_t pixel = 0; pixel < a.size(); ++pixel) {
    ASSERT_EQ(a.hit(pixel), b.hit(pixel));
    if (!a.hit(pixel)) continue;
    ++compared;
    // Snapped corners may differ by a subpixel where a rounding falls the other way: not here.
    // The point moves with the eye's rounding, less than 1e-9 m per axis, times depth over height
    // of the eye (the slope of the ray) for the depth.
    ASSERT_NEAR(a.depth_m[pixel], b.depth_m[pixel], 1e-9 * (1.0 + a.depth_m[pixel] / 2.0));
    ASSERT_NEAR(b.from_eye_m[pixel].z, -2.0, 1e-12);
  }
  EXPECT_GT(compared, 64 * 30);
}

}  // namespace
}  // namespace plumb::raster
