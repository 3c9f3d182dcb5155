#include "audit/camera_path.h"

#include <gtest/gtest.h>

#include "audit/scene.h"
#include "core/check.h"
#include "terrain/terrain_source.h"

namespace plumb::audit {
namespace {

constexpr const char* kFlight = R"(
[path]
frames = 5
width = 64
height = 32
far = 9000
[[key]]
eye = [0, 0, 100]
target = [0, 10, 0]
[[key]]
eye = [8, 0, 120]
target = [0, 20, 0]
[[key]]
eye = [8, 8, 100]
target = [0, 30, 0]
)";

std::string error_of(const std::string& text) {
  try {
    parse_camera_path(text, "p.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CameraPath, HasItsKeysAmongItsFrames) {
  const auto frames = parse_camera_path(kFlight, "p.toml");
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames[0].eye_m, glm::dvec3(0, 0, 100));
  EXPECT_EQ(frames[2].eye_m, glm::dvec3(8, 0, 120));
  EXPECT_EQ(frames[4].eye_m, glm::dvec3(8, 8, 100));
  EXPECT_EQ(frames[2].target_m, glm::dvec3(0, 20, 0));
  for (const CameraDescription& frame : frames) {
    EXPECT_EQ(frame.width_px, 64);
    EXPECT_EQ(frame.far_m, 9000.0);
  }
}

// Halfway from b to c the spline is (9 (b + c) - (a + d)) / 16; a is doubled at the start.
TEST(CameraPath, BendsBetweenItsKeys) {
  const auto frames = parse_camera_path(kFlight, "p.toml");
  const glm::dvec3 a{0, 0, 100}, c{8, 0, 120}, d{8, 8, 100};
  EXPECT_EQ(frames[1].eye_m, (9.0 * (a + c) - (a + d)) / 16.0);
}

TEST(CameraPath, IsStraightBetweenTwoKeys) {
  const auto frames = parse_camera_path(
      "[path]\nframes = 3\n[[key]]\neye = [0, 0, 10]\ntarget = [0, 1, 0]\n"
      "[[key]]\neye = [4, 0, 30]\ntarget = [0, 5, 0]\n",
      "p.toml");
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].eye_m, glm::dvec3(2, 0, 20));
  EXPECT_EQ(frames[1].target_m, glm::dvec3(0, 3, 0));
}

TEST(CameraPath, IsAListOfCamerasWordForWord) {
  const auto frames = parse_camera_path(
      "[[camera]]\npreset = \"top\"\n[[camera]]\neye = [0, 0, 9]\ntarget = [0, 1, 0]\n", "p.toml");
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].preset, "top");
  EXPECT_EQ(frames[1].eye_m, glm::dvec3(0, 0, 9));
}

TEST(CameraPath, OfACameraFileIsThatCamera) {
  EXPECT_EQ(parse_camera_path("preset = \"valley\"\n", "p.toml").size(), 1u);
}

TEST(CameraPath, OfAPresetHasItsFrames) {
  const auto frames = parse_camera_path("preset = \"zoom\"\nframes = 3\nwidth = 64\n", "p.toml");
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].frame, 2);
  EXPECT_EQ(frames[1].frames, 3);
  EXPECT_EQ(frames[1].width_px, 64);
  EXPECT_EQ(parse_camera_path("preset = \"flyover\"\n", "p.toml").size(), 60u);
  EXPECT_EQ(parse_camera_path("preset = \"zoom\"\nframe = 2\n", "p.toml").size(), 1u);
}

TEST(CameraPath, OfAPresetNeedsAFrameWhereOneCameraIsMeant) {
  const auto field = terrain::load_terrain("generate:alpine?size=17");
  CameraDescription zoom;
  zoom.preset = "zoom";
  EXPECT_THROW(resolve_camera(zoom, field), InputError);
  zoom.frame = 4;
  zoom.frames = 3;
  EXPECT_THROW(resolve_camera(zoom, field), InputError);
  zoom.frame = 3;
  const LookAt last = resolve_camera(zoom, field);
  zoom.frame = 1;
  EXPECT_LT(glm::length(last.eye_m - last.target_m),
            0.51 * glm::length(resolve_camera(zoom, field).eye_m - last.target_m));
}

TEST(CameraPath, OfAPresetIsWrittenIntoAScene) {
  Scene scene;
  scene.terrain = "generate:plane?size=9";
  scene.method = "full";
  scene.camera.preset = "flyover";
  scene.camera.frame = 7;
  scene.camera.frames = 30;
  EXPECT_EQ(parse_scene(to_toml(scene), "s.toml").camera, scene.camera);
}

TEST(CameraPath, SaysWhatIsWrong) {
  EXPECT_NE(error_of("preset = \"top\"\nframes = 3\n").find("preset that is a path"),
            std::string::npos);
  EXPECT_NE(error_of("[path]\nframes = 3\n").find("needs [[key]]"), std::string::npos);
  EXPECT_NE(error_of("[path]\n[[key]]\neye=[0,0,1]\ntarget=[0,1,0]\n").find("two keys"),
            std::string::npos);
  EXPECT_NE(error_of("[path]\n[[key]]\neye=[0,0,1]\ntarget=[0,1,0]\n[[key]]\neye=[0,0,2]\n"
                     "target=[0,1,0]\n")
                .find("frames"),
            std::string::npos);
  EXPECT_NE(error_of("[path]\nframes=2\n[[key]]\npreset=\"top\"\n[[key]]\npreset=\"top\"\n")
                .find("eye and target alone"),
            std::string::npos);
  EXPECT_NE(error_of("[path]\nframes=0\n[[key]]\neye=[0,0,1]\ntarget=[0,1,0]\n[[key]]\neye=[0,0,2]"
                     "\ntarget=[0,1,0]\n")
                .find("frames"),
            std::string::npos);
  EXPECT_NE(error_of("[[camera]]\npreset=\"top\"\n[sky]\nblue=1\n").find("sky"), std::string::npos);
}

constexpr const char* kEngine = R"(
view = [1,0,0,0, 0,0,-1,0, 0,1,0,0, -10,-30,20,1]
projection = [1,0,0,0, 0,2,0,0, 0,0,0,-1, 0,0,1,0]
clip = "d3d"
reverse_z = true
world_axes = "x,y,z"
width = 200
height = 100
)";

TEST(EngineCameraFile, IsPlacedByItsMatrices) {
  const PlacedCamera placed = place_camera(parse_camera_toml(kEngine, "e.toml"), {});
  EXPECT_EQ(placed.camera.eye_m, glm::dvec3(10, 20, 30));
  EXPECT_EQ(placed.camera.near_m, 1.0);
  EXPECT_EQ(placed.camera.width_px, 200);
}

TEST(EngineCameraFile, IsWrittenIntoAScene) {
  Scene scene;
  scene.terrain = "generate:plane?size=9";
  scene.method = "full";
  scene.camera = parse_camera_toml(kEngine, "e.toml");
  scene.camera.engine->metres_per_unit = 0.01;
  scene.camera.engine->world_origin_m = {1.0, 2.0, 0.1};
  EXPECT_EQ(parse_scene(to_toml(scene), "s.toml").camera, scene.camera);
}

TEST(EngineCameraFile, SaysWhatIsMissing) {
  const std::string text = kEngine;
  EXPECT_NE(error_of(text + "preset = \"top\"\n").find("either"), std::string::npos);
  EXPECT_NE(error_of("view = [1, 2]\n").find("sixteen"), std::string::npos);
  EXPECT_NE(error_of("clip = \"d3d\"\nwidth = 2\nheight = 2\n").find("both view and projection"),
            std::string::npos);
  EXPECT_NE(error_of(text + "layout = \"diagonal\"\n").find("column-major"), std::string::npos);
  CameraDescription mirrored = parse_camera_toml(kEngine, "e.toml");
  mirrored.engine->world_axes[0].sign = -1;
  EXPECT_THROW(place_camera(mirrored, {}), InputError);
}

}  // namespace
}  // namespace plumb::audit
