#include "audit/cost_maps.h"

#include <gtest/gtest.h>

#include <memory>

#include "audit/surface_picture.h"

namespace plumb::audit {
namespace {

// A right triangle with legs of 2 m across the line of sight.
DrawnSurface triangle_at(double distance_m) {
  DrawnSurface surface;
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices_m = {{-1, distance_m, -1}, {1, distance_m, -1}, {-1, distance_m, 1}};
  mesh->triangles = {{0, 1, 2}};
  surface.mesh = mesh;
  return surface;
}

// Looks along y; a metre at 10 m is gamma / 10 pixels.
Camera camera_of(int scale) {
  Camera camera;
  camera.eye_m = {0, 0, 0};
  camera.right = {1, 0, 0};
  camera.up = {0, 0, 1};
  camera.forward = {0, 1, 0};
  camera.width_px = camera.height_px = 32 * scale;
  camera.gamma_h = camera.gamma_v = 50.0 * scale;
  camera.centre_px = {16.0 * scale, 16.0 * scale};
  return camera;
}

float density(double distance_m, int scale) {
  const DrawnSurface surface = triangle_at(distance_m);
  const Camera camera = camera_of(scale);
  const HitImage drawn = picture_of(surface, camera).image;
  const std::vector<float> map = triangles_a_pixel(surface, drawn, camera);
  for (std::size_t k = 0; k < map.size(); ++k)
    if (drawn.hit(k)) return map[k];
  return -1.0f;
}

// At 10 m the legs are 10 pixels: an area of 50 square pixels.
TEST(TrianglesAPixel, AreOneOverTheAreaOnScreen) { EXPECT_FLOAT_EQ(density(10, 1), 1.0f / 50); }

TEST(TrianglesAPixel, AreAFourthInAPictureOfTwiceTheSize) {
  EXPECT_FLOAT_EQ(density(10, 2), density(10, 1) / 4);
}

TEST(TrianglesAPixel, AreNoneWhereNothingIsSeen) {
  const DrawnSurface surface = triangle_at(10);
  const Camera camera = camera_of(1);
  const HitImage drawn = picture_of(surface, camera).image;
  ASSERT_FALSE(drawn.hit(31));  // the corner at the top right
  EXPECT_EQ(triangles_a_pixel(surface, drawn, camera)[31], 0.0f);
}

}  // namespace
}  // namespace plumb::audit
