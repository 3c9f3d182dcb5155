#include "raster/shading/shade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "raster/rasteriser.h"

namespace plumb::raster {
namespace {

Camera level_camera(int width_px = 3, int height_px = 4) {
  return make_camera({.eye_m = {0, 0, 10},
                      .target_m = {0, 1, 10},
                      .fov_y_deg = 90,
                      .width_px = width_px,
                      .height_px = height_px});
}

// A picture that sees one point, straight ahead, with this normal; the rest is sky.
image::ColourImage shaded_point(const glm::dvec3& point_m, const glm::dvec3& normal,
                                const ShadeOptions& options) {
  const Camera camera = level_camera(1, 1);
  HitImage hits(1, 1);
  hits.depth_m[0] = point_m.y;
  hits.from_eye_m[0] = point_m - camera.eye_m;
  const std::vector<glm::dvec3> normals{normal};
  return shade(hits, camera, normals, options);
}

double brightness(const glm::dvec3& normal) {
  const auto image = shaded_point({0, 5, 0}, normal, {});
  return image.r[0] + image.g[0] + image.b[0];
}

// Level ground under a light at 45 degrees: 0.4 + 0.6 * sin 45, times the tint's green.
TEST(Shade, LightsLevelGroundByHand) {
  ShadeOptions options;
  options.light.ambient = 0.4;
  options.low_m = 0.0;
  options.high_m = 100.0;
  const auto image = shaded_point({0, 5, 0}, {0, 0, 1}, options);
  const double light = 0.4 + 0.6 * std::sqrt(0.5);
  EXPECT_FLOAT_EQ(image.g[0], static_cast<float>(hypsometric_tint(0.0).y * light));
}

TEST(Shade, MakesSlopesTowardsNorthWestTheBrightest) {
  const double s = 0.5;  // 45 degrees steep
  const double level = brightness({0, 0, 1});
  const double north_west = brightness(glm::dvec3(-s, s, std::sqrt(0.5)));
  const double south_east = brightness(glm::dvec3(s, -s, std::sqrt(0.5)));
  EXPECT_GT(north_west, level);
  EXPECT_GT(level, south_east);
  EXPECT_GT(south_east, 0.0);
}

TEST(Shade, LightsTheSideThatIsSeen) { EXPECT_EQ(brightness({0, -1, 0}), brightness({0, 1, 0})); }

TEST(Tint, RunsFromGreenToWhite) {
  const glm::dvec3 low = hypsometric_tint(0.0), high = hypsometric_tint(1.0);
  EXPECT_GT(low.y, low.x);
  EXPECT_GT(low.y, low.z);
  EXPECT_GT(std::min({high.x, high.y, high.z}), 0.9);
  EXPECT_EQ(hypsometric_tint(-3.0), low);
  EXPECT_EQ(hypsometric_tint(7.0), high);
  EXPECT_EQ(hypsometric_tint(NAN), low);
}

// Steps of 1/1000 change no colour by more than the steepest stop allows: 0.95 over 0.16.
TEST(Tint, HasNoJumps) {
  for (int k = 1; k <= 1000; ++k) {
    const glm::dvec3 step = hypsometric_tint(k / 1000.0) - hypsometric_tint((k - 1) / 1000.0);
    EXPECT_LT(std::max({std::abs(step.x), std::abs(step.y), std::abs(step.z)}), 0.006);
  }
}

// Four colours on the ground from (0, 0) to (2, 2) m: the file's top left lies in the north-west.
TEST(Shade, LaysAPictureOverTheGroundNorthUp) {
  image::ColourImage picture(2, 2);
  picture.r = {1, 2, 3, 4};
  ShadeOptions options;
  options.light = {{0, 0, 1}, 0.0};  // exactly one on level ground
  options.drape = {&picture, {0, 0}, {2, 2}};
  const auto red = [&](double x, double y) {
    return shaded_point({x, y, 0}, {0, 0, 1}, options).r[0];
  };
  EXPECT_EQ(red(0.5, 1.5), 1.0f);
  EXPECT_EQ(red(1.5, 1.5), 2.0f);
  EXPECT_EQ(red(0.5, 0.5), 3.0f);
  EXPECT_EQ(red(1.5, 0.5), 4.0f);
  EXPECT_EQ(red(1.0, 1.0), 2.5f);    // the mean, in the middle
  EXPECT_EQ(red(-9.0, 99.0), 1.0f);  // the border, outside
}

TEST(Shade, ShowsTheSkyOfEachDirection) {
  const Camera camera = level_camera();
  const HitImage nothing(3, 4);
  const std::vector<glm::dvec3> normals(12, glm::dvec3(0.0));
  const ShadeOptions options;
  const auto image = shade(nothing, camera, normals, options);
  EXPECT_LT(image.r[image.index(1, 0)], image.r[image.index(1, 1)]);  // bluer above
  EXPECT_EQ(image.b[image.index(1, 2)], static_cast<float>(options.sky.below.z));
  EXPECT_EQ(sky_colour(options.sky, {0, 0, 7}), options.sky.zenith);
  EXPECT_EQ(sky_colour(options.sky, {3, 0, 0}), options.sky.horizon);
}

TEST(Shade, HidesHalfInHazeAtItsDepth) {
  ShadeOptions options;
  options.haze_m = 5.0;
  const float clear = shaded_point({0, 5, 0}, {0, 0, 1}, {}).b[0];
  const float hazy = shaded_point({0, 5, 0}, {0, 0, 1}, options).b[0];
  EXPECT_FLOAT_EQ(hazy, 0.5f * clear + 0.5f * static_cast<float>(options.sky.horizon.z));
}

TEST(FlatNormals, PointUpwardsFromATerrain) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {4, 0, 3}, {0, 5, 0}};  // rises 3 in 4 towards east
  mesh.triangles = {{0, 1, 2}};
  HitImage hits(2, 1);
  hits.depth_m[1] = 1.0;
  hits.primitive[1] = 0;
  const auto normals = flat_normals(mesh, hits);
  EXPECT_EQ(normals[0], glm::dvec3(0.0));
  EXPECT_EQ(normals[1], glm::dvec3(-0.6, 0.0, 0.8));
  hits.primitive[1] = 1;
  EXPECT_THROW(flat_normals(mesh, hits), std::invalid_argument);
}

TEST(Shade, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Camera camera = make_camera({.eye_m = {0, -30, 20}, .width_px = 320, .height_px = 200});
  TriangleMesh mesh;
  for (int k = 0; k < 64; ++k) {
    mesh.vertices_m.push_back({k % 8 * 9.0 - 32, k / 8 * 9.0 - 32, (k * 37 % 11) * 1.0});
  }
  for (std::uint32_t k = 0; k + 9 < 64; ++k) {
    if (k % 8 < 7) mesh.triangles.push_back({k, k + 1, k + 8});
  }
  const HitImage hits = rasterise(mesh, camera).image;
  ShadeOptions options;
  options.high_m = 10.0;
  const image::ColourImage first = shade(hits, camera, flat_normals(mesh, hits), options);
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(shade(hits, camera, flat_normals(mesh, hits), options), first);
  }
}

TEST(Shade, RefusesShapesAndOptionsOutOfRange) {
  const HitImage hits(3, 4);
  const std::vector<glm::dvec3> normals(12, glm::dvec3(0.0)), few(11, glm::dvec3(0.0));
  const Camera camera = level_camera();
  EXPECT_THROW(shade(hits, camera, few), std::invalid_argument);
  EXPECT_THROW(shade(hits, level_camera(4, 3), normals), std::invalid_argument);
  ShadeOptions options;
  options.light.ambient = 1.5;
  EXPECT_THROW(shade(hits, camera, normals, options), std::invalid_argument);
  options = {};
  options.light.towards = glm::dvec3(0.0);
  EXPECT_THROW(shade(hits, camera, normals, options), std::invalid_argument);
  options = {};
  options.haze_m = 0.0;
  EXPECT_THROW(shade(hits, camera, normals, options), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::raster
