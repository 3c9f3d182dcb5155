#include "common_options.h"

#include <gtest/gtest.h>

#include "core/check.h"
#include "terrain/camera_presets.h"

namespace plumb::tool {
namespace {

terrain::Heightfield plain() {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(9, 9, 10.0f);
  field.dx_m = field.dy_m = 20.0;
  return field;
}

TEST(ParseSize, TakesTwoWholeNumbers) {
  EXPECT_EQ(parse_size("1920x1080").width_px, 1920);
  EXPECT_EQ(parse_size("1920x1080").height_px, 1080);
  for (const char* wrong :
       {"", "x", "1920", "0x4", "4x0", "65537x1", "4x4x4", "4,4", "4 x 4", "-4x4"})
    EXPECT_THROW(parse_size(wrong), InputError) << wrong;
}

TEST(ReadOptionsOfTheCommand, AreWhatTheOptionsSay) {
  TerrainOptions options;
  options.window = "1,2,30,40";
  options.spacing = "5,6";
  options.decode = "terrarium";
  options.no_data_policy = "fill";
  options.band = 3;
  options.no_data = -1.0;
  const terrain::ReadOptions read = read_options(options);
  EXPECT_EQ(read.window, (terrain::Window{1, 2, 30, 40}));
  EXPECT_EQ(read.spacing_x_m, 5.0);
  EXPECT_EQ(read.spacing_y_m, 6.0);
  EXPECT_EQ(read.decode, terrain::Decode::Terrarium);
  EXPECT_EQ(read.no_data_policy, terrain::NoDataPolicy::Fill);
  EXPECT_EQ(read.band, 3);
  EXPECT_EQ(read.no_data, -1.0);
}

TEST(LookAtOfTheCommand, IsThePresetForTheSizeAndAngleAskedFor) {
  const audit::CameraDescription camera =
      placed_camera({"top", "200x100", 30.0}, plain()).description;
  const LookAt preset = terrain::preset_camera(plain(), "top", 200, 100, 30.0);
  EXPECT_EQ(camera.eye_m, preset.eye_m);
  EXPECT_EQ(camera.width_px, 200);
  EXPECT_EQ(camera.height_px, 100);
  EXPECT_EQ(camera.fov_y_deg, 30.0);
}

TEST(LookAtOfTheCommand, IsTheNumbersGiven) {
  const audit::CameraDescription camera =
      placed_camera({"1,2,300,4,5,6,70", "", std::nullopt}, plain()).description;
  EXPECT_EQ(camera.eye_m, glm::dvec3(1, 2, 300));
  EXPECT_EQ(camera.fov_y_deg, 70.0);
  EXPECT_EQ(camera.width_px, 1920);
  EXPECT_EQ(placed_camera({"1,2,300,4,5,6,70", "", 20.0}, plain()).description.fov_y_deg, 20.0);
}

TEST(LookAtOfTheCommand, RefusesUnknownPresetsAndMissingFiles) {
  EXPECT_THROW(placed_camera({"sideways", "", std::nullopt}, plain()), InputError);
  EXPECT_THROW(placed_camera({"none.toml", "", std::nullopt}, plain()), InputError);
}

}  // namespace
}  // namespace plumb::tool
