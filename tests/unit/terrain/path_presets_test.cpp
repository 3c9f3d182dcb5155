// Paths that suit any terrain.
#include "terrain/path_presets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/check.h"
#include "support/test_terrain.h"
#include "terrain/sight.h"
#include "terrain/terrain_source.h"

namespace plumb::terrain {
namespace {

Heightfield hills() {
  Heightfield field = test_support::rough_terrain(129, 97, 5, 300.0);
  field.origin_m = {500000.0, 4000000.0};
  return field;
}

LookAt frame_of(const Heightfield& field, const char* path, int frame, int frames) {
  return path_preset_camera(field, path, frame, frames, 160, 90, 50.0);
}

TEST(PathPreset, BeginsAtTheObliqueView) {
  const LookAt view = preset_camera(hills(), "oblique", 160, 90, 50.0);
  const LookAt zoom = frame_of(hills(), "zoom", 1, 10);
  EXPECT_EQ(glm::length(zoom.eye_m - view.eye_m), 0.0);
  EXPECT_EQ(zoom.target_m, view.target_m);
  // A flight may begin higher, to clear what lies ahead.
  const LookAt flight = frame_of(hills(), "flyover", 1, 10);
  EXPECT_EQ(flight.eye_m.x, view.eye_m.x);
  EXPECT_EQ(flight.eye_m.y, view.eye_m.y);
  EXPECT_GE(flight.eye_m.z, view.eye_m.z);
}

// Steps of a sum of coordinates up to 4e6, rounded twice.
TEST(PathPreset, FliesLevelInEqualSteps) {
  const Heightfield field = hills();
  const glm::dvec3 step =
      frame_of(field, "flyover", 2, 5).eye_m - frame_of(field, "flyover", 1, 5).eye_m;
  EXPECT_GT(glm::length(step), 10.0);
  EXPECT_EQ(step.z, 0.0);
  for (int k = 1; k < 5; ++k) {
    const LookAt a = frame_of(field, "flyover", k, 5), b = frame_of(field, "flyover", k + 1, 5);
    EXPECT_LT(glm::length((b.eye_m - a.eye_m) - step), 4e6 * 2.3e-16 * 8);
    EXPECT_LT(glm::length((b.target_m - b.eye_m) - (a.target_m - a.eye_m)), 4e6 * 2.3e-16 * 8);
  }
}

TEST(PathPreset, ZoomsToHalfTheDistanceByOneFactor) {
  const Heightfield field = hills();
  const auto distance = [&](int frame) {
    const LookAt view = frame_of(field, "zoom", frame, 5);
    return glm::length(view.target_m - view.eye_m);
  };
  // exp and log of core: each within a few 1e-16; coordinates of 4e6 m cost 1e-9 m of some 1000.
  EXPECT_NEAR(distance(5) / distance(1), 0.5, 1e-11);
  for (int k = 1; k < 5; ++k)
    EXPECT_NEAR(distance(k + 1) / distance(k), std::pow(0.5, 0.25), 1e-11);
}

TEST(PathPreset, HasEndsThatDoNotDependOnTheNumberOfFrames) {
  for (const char* path : {"flyover", "zoom"}) {
    EXPECT_EQ(frame_of(hills(), path, 3, 3).eye_m, frame_of(hills(), path, 90, 90).eye_m) << path;
    EXPECT_EQ(frame_of(hills(), path, 1, 1).eye_m, frame_of(hills(), path, 1, 90).eye_m) << path;
  }
}

TEST(PathPreset, StaysAboveTheGroundOfEveryGenerator) {
  for (const GeneratorHelp& help : generator_help()) {
    const Heightfield field = load_terrain(test_support::heights_of(help, "size=65"));
    for (const char* path : {"flyover", "zoom"}) {
      for (int frame = 1; frame <= 9; ++frame) {
        const LookAt view = frame_of(field, path, frame, 9);
        const glm::dvec3 eye = view.eye_m - field.world_origin_m();
        const double ground = ground_height_m(field, eye.x, eye.y);
        if (std::isnan(ground)) continue;
        EXPECT_GT(eye.z, ground) << help.name << " " << path << " " << frame;
        EXPECT_GT(view.near_m, 0.0);
      }
    }
  }
}

TEST(PathPreset, RefusesWhatItDoesNotKnow) {
  EXPECT_THROW(frame_of(hills(), "oblique", 1, 2), InputError);
  EXPECT_THROW(frame_of(hills(), "zoom", 3, 2), std::invalid_argument);
  EXPECT_THROW(frame_of(hills(), "zoom", 0, 2), std::invalid_argument);
  EXPECT_THROW(frame_of(hills(), "zoom", 1, 0), std::invalid_argument);
  EXPECT_TRUE(is_path_preset("flyover"));
  EXPECT_FALSE(is_path_preset("top"));
}

}  // namespace
}  // namespace plumb::terrain
