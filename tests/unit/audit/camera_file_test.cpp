#include "audit/camera_file.h"
#include "audit/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/check.h"
#include "core/reproducible_math.h"
#include "support/run_command.h"
#include "terrain/camera_presets.h"

namespace plumb::audit {
namespace {

constexpr const char* kWhole = R"(# a camera
eye = [1, 2.5, 300]
target = [4, 5, 6]
up = [0.0, 1.0, 0.0]
fov_y_deg = 35
width = 640
height = 480
near = 0.5
far = 1e5
)";

terrain::Heightfield hill() {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(17, 17, 10.0f);
  field.heights_m.floats()(8, 8) = 40.0f;
  field.dx_m = field.dy_m = 20.0;
  return field;
}

std::string error_of(const std::string& text) {
  try {
    parse_camera_toml(text, "c.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string numbers_error(const std::string& text) {
  try {
    parse_camera_numbers(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CameraFile, GivesEveryValueThatItHolds) {
  const CameraDescription camera = parse_camera_toml(kWhole, "c.toml");
  EXPECT_EQ(camera.eye_m, glm::dvec3(1, 2.5, 300));
  EXPECT_EQ(camera.target_m, glm::dvec3(4, 5, 6));
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(camera.fov_y_deg, 35.0);
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.near_m, 0.5);
  EXPECT_EQ(camera.far_m, 1e5);
  EXPECT_EQ(camera.preset, "");
}

TEST(CameraFile, BecomesTheCameraThatItDescribes) {
  const LookAt camera = resolve_camera(parse_camera_toml(kWhole, "c.toml"), hill());
  EXPECT_EQ(camera.eye_m, glm::dvec3(1, 2.5, 300));
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.near_m, 0.5);
  EXPECT_EQ(camera.far_m, 1e5);
}

TEST(CameraFile, LeavesTheDefaultsWhereItSaysNothing) {
  const LookAt camera =
      resolve_camera(parse_camera_toml("eye = [0, 0, 9]\ntarget = [1, 1, 0]", "c"), hill());
  EXPECT_EQ(camera.width_px, 1920);
  EXPECT_EQ(camera.height_px, 1080);
  EXPECT_EQ(camera.fov_y_deg, 50.0);
  EXPECT_EQ(camera.up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(camera.near_m, LookAt{}.near_m);
}

TEST(CameraFile, MayNameAPreset) {
  const LookAt camera =
      resolve_camera(parse_camera_toml("preset = \"top\"\nwidth = 100\nheight = 50", "c"), hill());
  const LookAt preset = terrain::preset_camera(hill(), "top", 100, 50, 50.0);
  EXPECT_EQ(camera.eye_m, preset.eye_m);
  EXPECT_EQ(camera.near_m, preset.near_m);
  EXPECT_EQ(camera.width_px, 100);
}

TEST(CameraFile, NamesTheKnownKeysForAnUnknownOne) {
  EXPECT_EQ(error_of("eye = [0,0,1]\ntarget = [1,1,1]\nfov = 40"),
            "c.toml, line 3: fov: unknown key; a camera has eye, target, up, fov_y_deg, width, "
            "height, near, far, tilt_deg, view, projection, layout, vectors, clip, reverse_z, "
            "world_axes, "
            "metres_per_unit, origin, preset, frame, frames");
}

TEST(CameraFile, SaysWhereAValueIsOfTheWrongKind) {
  EXPECT_EQ(error_of("eye = [0, 0]\n"), "c.toml, line 1: eye: expected three numbers, [x, y, z]");
  EXPECT_EQ(error_of("eye = [0, 0, \"1\"]\n"), "c.toml, line 1: eye: expected a number");
  EXPECT_EQ(error_of("eye = [0, 0, inf]\n"), "c.toml, line 1: eye: expected finite numbers");
  EXPECT_EQ(error_of("\nwidth = 1.5\n"),
            "c.toml, line 2: width: expected a whole number from 1 to 65536");
  EXPECT_EQ(error_of("height = 0\n"),
            "c.toml, line 1: height: expected a whole number from 1 to 65536");
  EXPECT_EQ(error_of("fov_y_deg = true\n"), "c.toml, line 1: fov_y_deg: expected a number");
  EXPECT_EQ(error_of("preset = 3\n"), "c.toml, line 1: preset: expected a name in quotes");
  EXPECT_EQ(error_of("eye = [0, 0\n").rfind("c.toml, line ", 0), 0u);
}

TEST(CameraFile, WantsEitherAPresetOrEyeAndTarget) {
  EXPECT_EQ(error_of("eye = [0, 0, 1]\n"), "c.toml: a camera needs eye and target, or a preset");
  EXPECT_EQ(error_of(""), "c.toml: a camera needs eye and target, or a preset");
  EXPECT_EQ(error_of("preset = \"top\"\neye = [0, 0, 1]\n"),
            "c.toml: a camera has either a preset or eye, target and up, not both");
}

TEST(CameraFile, IsReadFromDisk) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("c.toml")) << kWhole;
  EXPECT_EQ(read_camera_file(folder.file("c.toml")), parse_camera_toml(kWhole, ""));
  EXPECT_THROW(read_camera_file(folder.file("none.toml")), InputError);
  EXPECT_THROW(read_camera_file(folder.path().string()), InputError);
}

TEST(CameraNumbers, AreSixOrSeven) {
  const auto camera = parse_camera_numbers("-1,2.5,3e2,4,5,6");
  ASSERT_TRUE(camera.has_value());
  EXPECT_EQ(camera->eye_m, glm::dvec3(-1, 2.5, 300));
  EXPECT_EQ(camera->target_m, glm::dvec3(4, 5, 6));
  EXPECT_FALSE(camera->fov_y_deg.has_value());
  EXPECT_EQ(parse_camera_numbers("1,2,3,4,5,6,70")->fov_y_deg, 70.0);
  EXPECT_FALSE(parse_camera_numbers("oblique").has_value());
}

TEST(CameraNumbers, AreRefusedIfTheyAreNot) {
  EXPECT_EQ(numbers_error("1,2,3"),
            "camera '1,2,3': expected six or seven numbers, ex,ey,ez,tx,ty,tz[,fov]");
  EXPECT_EQ(numbers_error("1,2,3,4,5,6,"),
            "camera '1,2,3,4,5,6,': expected six or seven numbers, ex,ey,ez,tx,ty,tz[,fov]");
  EXPECT_EQ(numbers_error("1,2,3,4,5,x"), "camera '1,2,3,4,5,x': 'x' is not a finite number");
  EXPECT_EQ(numbers_error("1,2,3,4,5,nan"), "camera '1,2,3,4,5,nan': 'nan' is not a finite number");
}

TEST(InlineCamera, IsWhatStandsInAFile) {
  EXPECT_EQ(parse_inline_camera("{eye = [1, 2, 3], target = [4, 5, 6.5], near = 0.25, width = 7}"),
            parse_camera_toml("eye = [1, 2, 3]\ntarget = [4, 5, 6.5]\nnear = 0.25\nwidth = 7", ""));
}

TEST(InlineCamera, ReadsWhatIsWrittenToTheLastBit) {
  const CameraDescription written = parse_camera_toml(kWhole, "");
  EXPECT_EQ(parse_inline_camera(inline_toml(written)), written);
}

TEST(InlineCamera, IsRefusedIfItIsNoCamera) {
  for (const char* text : {"{eye = [1, 2, 3]}", "{eye = [1, 2, 3], target = [1, 2]}", "{", "{}",
                           "{eye = [1, 2, 3], target = [4, 5, 6], fov = 50}",
                           "{eye = [1, 2, 3], target = [4, 5, 6]}\nup = 3"})
    EXPECT_THROW(parse_inline_camera(text), InputError) << text;
}

// A point of the tilted hill, where the camera that was asked for sees it, is the point of the
// level hill where the turned camera sees that. Roundings of coordinates of some hundred metres.
TEST(ResolveCamera, TurnsForATiltedTerrain) {
  const terrain::Heightfield field = hill();
  const LookAt asked = resolve_camera(
      parse_camera_toml("eye = [160, -300, 200]\ntarget = [160, 160, 25]\n", "c"), field);
  const glm::dvec3 middle{160.0, 160.0, 25.0};  // of the hill's box
  for (const double tilt_deg : {0.0, 30.0, 90.0, -45.0}) {
    const LookAt turned = turned_for_tilt(asked, tilt_deg, field);
    const double c = std::cos(radians(tilt_deg)), s = std::sin(radians(tilt_deg));
    for (const glm::dvec3& p : {glm::dvec3(0, 0, 10), glm::dvec3(160, 160, 40),
                                glm::dvec3(320, 320, 10), glm::dvec3(320, 40, 10)}) {
      const glm::dvec3 d = p - middle;
      const glm::dvec3 tilted = middle + glm::dvec3(d.x, c * d.y - s * d.z, s * d.y + c * d.z);
      const Camera before = make_camera(asked), after = make_camera(turned);
      const glm::dvec2 expected = view_to_pixel(before, to_view(before, tilted));
      const glm::dvec2 found = view_to_pixel(after, to_view(after, p));
      EXPECT_NEAR(found.x, expected.x, 1e-9);
      EXPECT_NEAR(found.y, expected.y, 1e-9);
    }
  }
  // North goes up.
  EXPECT_LT(turned_for_tilt(asked, 90.0, field).up.z, 1e-15);
  EXPECT_GT(turned_for_tilt(asked, 90.0, field).up.y, 0.99);
  EXPECT_THROW(turned_for_tilt(asked, 181.0, field), InputError);
}

TEST(ResolveCamera, RefusesWhatIsNoCamera) {
  const auto resolve = [](const std::string& more) {
    return resolve_camera(parse_camera_toml("eye = [0, 0, 1]\ntarget = [1, 0, 0]\n" + more, "c"),
                          hill());
  };
  EXPECT_NO_THROW(resolve(""));
  EXPECT_THROW(resolve("fov_y_deg = 180"), InputError);
  EXPECT_THROW(resolve("fov_y_deg = nan"), InputError);
  EXPECT_THROW(resolve("near = 0"), InputError);
  EXPECT_THROW(resolve("near = 5\nfar = 5"), InputError);
  EXPECT_THROW(resolve("up = [0, 0, 0]"), InputError);
  EXPECT_THROW(resolve_camera(*parse_camera_numbers("1,2,3,1,2,3"), hill()), InputError);
  EXPECT_THROW(resolve_camera(parse_camera_toml("preset = \"sideways\"", "c"), hill()), InputError);
}

}  // namespace
}  // namespace plumb::audit
