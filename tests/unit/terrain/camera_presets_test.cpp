#include "terrain/camera_presets.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/check.h"
#include "terrain/generators.h"

namespace plumb::terrain {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr double kFov_deg = 50.0;

LookAt preset(const Heightfield& field, const std::string& name) {
  return preset_camera(field, name, kWidth, kHeight, kFov_deg);
}

TEST(CameraPresets, UnknownNamesListTheKnownOnes) {
  try {
    preset(generate("generate:plane?size=3"), "obliqe");
    FAIL() << "it was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "camera preset 'obliqe': expected oblique, top, grazing, valley, flyover, zoom");
  }
}

TEST(CameraPresets, APictureThatCannotBeIsRefused) {
  const Heightfield field = generate("generate:plane?size=3");
  EXPECT_THROW(preset_camera(field, "top", 0, 10, 50.0), std::invalid_argument);
  EXPECT_THROW(preset_camera(field, "top", 10, 10, 180.0), std::invalid_argument);
}

TEST(CameraPresets, ThePictureIsThatAskedFor) {
  const LookAt view = preset(generate("generate:alpine?size=33"), "oblique");
  EXPECT_EQ(view.width_px, kWidth);
  EXPECT_EQ(view.height_px, kHeight);
  EXPECT_EQ(view.fov_y_deg, kFov_deg);
}

// A square of 2560 m under a picture of 16:9 is bound by its height: the eye stands
// 1.05 * 1280 m / tan(25 degrees) above it.
TEST(CameraPresets, TopStandsOverTheMiddleWithNorthUp) {
  const Heightfield field = generate("generate:plane?height=100&origin=1000,2000");
  const LookAt view = preset(field, "top");
  EXPECT_EQ(view.eye_m.x, 1000.0 + 1280.0);
  EXPECT_EQ(view.eye_m.y, 2000.0 + 1280.0);
  EXPECT_NEAR(view.eye_m.z, 100.0 + 1.05 * 1280.0 / 0.46630765815499859, 1e-9);
  const Camera camera = make_camera(view);
  EXPECT_EQ(camera.up, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(camera.right, glm::dvec3(1.0, 0.0, 0.0));
}

TEST(CameraPresets, TopHasEverySampleInThePicture) {
  for (const char* argument : {"generate:alpine?size=65", "generate:alpine?size=9x101",
                               "generate:alpine?size=200x7&voids=0.4", "generate:spike?size=5"}) {
    const Heightfield field = generate(argument);
    const Camera camera = make_camera(preset(field, "top"));
    for (int j = 0; j < field.rows(); ++j) {
      for (int i = 0; i < field.columns(); ++i) {
        if (field.is_void(i, j)) continue;
        const glm::dvec3 view =
            to_view(camera, {i * field.dx_m, j * field.dy_m, field.heights_m(i, j)});
        const glm::dvec2 pixel = view_to_pixel(camera, view);
        ASSERT_GT(view.z, camera.near_m) << argument;
        ASSERT_TRUE(pixel.x >= 0.0 && pixel.x <= kWidth) << argument;
        ASSERT_TRUE(pixel.y >= 0.0 && pixel.y <= kHeight) << argument;
      }
    }
  }
}

TEST(CameraPresets, GrazingStandsTwoMetresAboveFineGround) {
  const Heightfield field = generate("generate:plane?size=65&spacing=1&height=10");
  EXPECT_EQ(preset(field, "grazing").eye_m.z, 12.0);
  EXPECT_EQ(preset(field, "grazing").near_m, 0.2);
}

TEST(CameraPresets, GrazingStandsATenthOfASpacingAboveCoarseGround) {
  const Heightfield field = generate("generate:plane?size=65&spacing=100&height=10");
  EXPECT_EQ(preset(field, "grazing").eye_m.z, 20.0);
}

// A trough that rises northwards, 64 columns wide: sides rise 1 in 2 from its middle line.
TEST(CameraPresets, ValleyStandsOnTheFloorAndLooksAlong) {
  Heightfield field;
  field.dx_m = field.dy_m = 10.0;
  field.heights_m = Grid<float>(65, 65);
  for (int j = 0; j < 65; ++j) {
    for (int i = 0; i < 65; ++i) {
      field.heights_m.floats()(i, j) = static_cast<float>(5.0 * std::abs(i - 32) + 0.5 * j);
    }
  }
  const LookAt view = preset(field, "valley");
  EXPECT_LT(std::abs(view.eye_m.x - 320.0), 30.0);  // within three spacings of the middle line
  const glm::dvec3 forward = make_camera(view).forward;
  EXPECT_GT(std::abs(forward.y), 0.9);  // along it, not across
}

TEST(CameraPresets, ObliqueSeesMostlyGroundAndSomeSky) {
  const LookAt view = preset(generate("generate:plane"), "oblique");
  const Camera camera = make_camera(view);
  // The eye is above the ground, looks down, and the picture's upper edge looks into the sky.
  EXPECT_GT(view.eye_m.z, 100.0);
  EXPECT_LT(camera.forward.z, 0.0);
  EXPECT_GT(ray_direction(camera, kWidth / 2.0, 0.5).z, 0.0);
}

TEST(CameraPresets, MoveWithTheOrigin) {
  const Heightfield here = generate("generate:alpine?size=65");
  const Heightfield there = generate("generate:alpine?size=65&utm=1");
  for (const PresetHelp& help : preset_help()) {
    const LookAt a = preset(here, help.name), b = preset(there, help.name);
    EXPECT_EQ(b.eye_m, a.eye_m + there.world_origin_m()) << help.name;
    EXPECT_EQ(a.near_m, b.near_m);
  }
}

TEST(CameraPresets, WithoutACellTheyLookAtASample) {
  for (const char* argument : {"generate:plane?size=1", "generate:plane?size=5x1",
                               "generate:plane?size=1x5", "generate:plane?size=9&voids=1"}) {
    const Heightfield field = generate(argument);
    for (const PresetHelp& help : preset_help()) {
      const LookAt view = preset(field, help.name);
      EXPECT_GT(view.eye_m.z, view.target_m.z) << argument << " " << help.name;
      EXPECT_NO_THROW(make_camera(view)) << argument << " " << help.name;
    }
  }
}

}  // namespace
}  // namespace plumb::terrain
