// Every preset finds a view of every terrain.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "core/parallel.h"
#include "support/test_terrain.h"
#include "terrain/camera_presets.h"
#include "terrain/generators.h"
#include "terrain/terrain_source.h"

namespace plumb::terrain {
namespace {

constexpr int kWidth = 160, kHeight = 90;

/// Height of a cell's ground by bilinear interpolation, which lies between its two triangulations
/// or on them; nothing outside or where a sample is void.
std::optional<double> ground(const Heightfield& f, double x_m, double y_m) {
  const double x = x_m / f.dx_m, y = y_m / f.dy_m;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  if (i < 0 || j < 0 || i >= f.cell_columns() || j >= f.cell_rows()) return std::nullopt;
  const double u = x - i, v = y - j;
  const double south = (1 - u) * f.heights_m(i, j) + u * f.heights_m(i + 1, j);
  const double north = (1 - u) * f.heights_m(i, j + 1) + u * f.heights_m(i + 1, j + 1);
  const double height = (1 - v) * south + v * north;
  return std::isnan(height) ? std::nullopt : std::optional<double>(height);
}

/// True if a ray comes under the ground, by equal steps of a third of a spacing.
bool meets_ground(const Heightfield& f, const glm::dvec3& eye, const glm::dvec3& direction) {
  const double length =
      std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
  const double step = std::min(f.dx_m, f.dy_m) / 3.0 / length;
  const double farthest =
      8.0 * (f.columns() * f.dx_m + f.rows() * f.dy_m + std::abs(eye.z)) / length;
  for (double t = 0.0; t < farthest; t += step) {
    const glm::dvec3 p = eye + t * direction;
    const auto height = ground(f, p.x, p.y);
    if (height && p.z <= *height) return true;
  }
  return false;
}

void expect_good_view(const Heightfield& f, const std::string& name, const std::string& argument) {
  const LookAt view = preset_camera(f, name, kWidth, kHeight, 50.0);
  const Camera camera = relative_to(make_camera(view), f.world_origin_m());
  const auto below = ground(f, camera.eye_m.x, camera.eye_m.y);
  if (name != "top") {
    ASSERT_TRUE(below.has_value()) << argument << " " << name << ": the eye stands over no ground";
  }
  if (below) {
    EXPECT_GT(camera.eye_m.z, *below) << argument << " " << name;
  }
  EXPECT_GE(view.near_m, 0.01) << argument << " " << name;
  int hits = 0;
  for (const double down : {0.42, 0.5, 0.58}) {
    for (const double across : {0.42, 0.5, 0.58}) {
      hits += meets_ground(f, camera.eye_m, ray_direction(camera, across * kWidth, down * kHeight))
                  ? 1
                  : 0;
    }
  }
  EXPECT_GT(hits, 0) << argument << " " << name << ": nothing in the middle of the picture";
}

TEST(EveryPreset, SeesGroundFromAboveIt) {
  for (const GeneratorHelp& help : generator_help()) {
    for (const char* shape :
         {"size=129", "size=2", "size=3x2", "size=200x9&spacing=3", "size=5x90&spacing=40,10",
          "size=97&utm=1&voids=0.2", "size=64x80&voids=0.7&seed=4"}) {
      const std::string argument = test_support::heights_of(help, shape);
      const Heightfield field = generate(argument);
      for (const PresetHelp& preset : preset_help()) {
        expect_good_view(field, preset.name, argument);
      }
    }
  }
}

TEST(EveryPreset, SeesGroundOfRealTerrains) {
  int seen = 0;
  for (const char* name : {"srtm3_alps_N46E008.tif", "ahn_dsm_0p5m_963x840.tif", "N65E029.hgt",
                           "jacksboro_fault_403x344.tif"}) {
    const std::string file = std::string(PLUMB_SOURCE_DIR) + "/../shared/data/" + name;
    if (!std::filesystem::exists(file)) continue;
    const Heightfield field = load_terrain(file);
    for (const PresetHelp& preset : preset_help()) expect_good_view(field, preset.name, name);
    ++seen;
  }
  if (seen == 0) GTEST_SKIP() << "the project's elevation files are not here";
}

TEST(LongEveryPreset, SeesGroundOfLargeTerrains) {
  int seen = 0;
  for (const char* name :
       {"taiwan_central_8193.tif", "narok_kenya_5840x4934.tif", "etopo5_global_4320x2161.tif"}) {
    const std::string file = std::string(PLUMB_SOURCE_DIR) + "/../shared/data/" + name;
    if (!std::filesystem::exists(file)) continue;
    const Heightfield field = load_terrain(file);
    for (const PresetHelp& preset : preset_help()) expect_good_view(field, preset.name, name);
    ++seen;
  }
  if (seen == 0) GTEST_SKIP() << "the project's elevation files are not here";
}

TEST(EveryPreset, IsTheSameOnAnyNumberOfThreads) {
  const Heightfield field = generate("generate:alpine?size=129&voids=0.1");
  for (const PresetHelp& preset : preset_help()) {
    std::vector<LookAt> views;
    for (const int threads : {1, 2, 7}) {
      const ThreadLimit limit(threads);
      views.push_back(preset_camera(field, preset.name, kWidth, kHeight, 50.0));
    }
    for (const LookAt& view : views) {
      EXPECT_EQ(view.eye_m, views[0].eye_m) << preset.name;
      EXPECT_EQ(view.target_m, views[0].target_m) << preset.name;
    }
  }
}

TEST(EveryPreset, DoesNotFailForAnyPicture) {
  const Heightfield field = generate("generate:alpine?size=33");
  for (const PresetHelp& preset : preset_help()) {
    for (const double fov_deg : {0.5, 20.0, 120.0, 170.0}) {
      EXPECT_NO_THROW(make_camera(preset_camera(field, preset.name, 1, 900, fov_deg)));
      EXPECT_NO_THROW(make_camera(preset_camera(field, preset.name, 5000, 3, fov_deg)));
    }
  }
}

}  // namespace
}  // namespace plumb::terrain
