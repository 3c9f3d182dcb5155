#include "raster/shading/blend.h"

#include <gtest/gtest.h>

namespace plumb::raster {
namespace {

// Two pixels: one all background, one with a layer of a quarter, a half behind it, and so a quarter
// of fog.
TEST(Blend, WeighsLayersBackgroundAndFog) {
  const Camera camera =
      make_camera({.eye_m = {0, 0, 10}, .target_m = {0, 1, 10}, .width_px = 2, .height_px = 1});
  image::ColourImage behind(2, 1);
  behind.r = {0.5f, 0.25f};
  behind.g = {0.5f, 0.5f};
  behind.b = {0.5f, 1.0f};
  Layers layers;
  layers.first = {0, 0, 1};
  layers.layers = {{{0.0, 5.0, -10.0}, 0.25f}};
  layers.behind = {1.0f, 0.5f};
  layers.fog = {1.0, 0.0, 0.5};
  const std::vector<glm::dvec3> normals{{0.0, 0.0, 1.0}};
  const ShadeOptions options;
  const image::ColourImage blended = blend(behind, layers, normals, camera, options);
  EXPECT_EQ(blended.r[0], 0.5f);
  EXPECT_EQ(blended.b[0], 0.5f);
  const glm::dvec3 ground =
      surface_colour(camera, layers.layers[0].from_eye_m, normals[0], 5.0, options);
  EXPECT_FLOAT_EQ(blended.r[1], static_cast<float>(0.25 * ground.x + 0.5 * 0.25 + 0.25));
  EXPECT_FLOAT_EQ(blended.g[1], static_cast<float>(0.25 * ground.y + 0.5 * 0.5));
  EXPECT_FLOAT_EQ(blended.b[1], static_cast<float>(0.25 * ground.z + 0.5 * 1.0 + 0.25 * 0.5));
  EXPECT_EQ(blend(behind, {}, {}, camera, options), behind);
  layers.behind.pop_back();
  EXPECT_THROW(blend(behind, layers, normals, camera, options), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::raster
