#include "core/engine_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace plumb {
namespace {

// One scene by hand. The eye stands at (10, 20, 30) east, north, up and looks north; the window is
// 200 x 100, and the projection's sizes are 1 across and 2 upwards. A point 3 m to the right, 1.5 m
// up and 6 m ahead has x / w = 3 / 6 = 0.5, y / w = 2 * 1.5 / 6 = 0.5: pixel (150, 25).
constexpr glm::dvec3 kPoint{13.0, 26.0, 31.5};
constexpr glm::dvec2 kPixel{150.0, 25.0};

using Matrix = std::array<double, 16>;

// Right-handed, z up, OpenGL's view space (x right, y up, z backwards), near 1, far 101.
constexpr Matrix kView{1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, -10, -30, 20, 1};
constexpr Matrix kProjection{1, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.02, -1, 0, 0, -2.02, 0};

EngineCamera open_gl() {
  EngineCamera engine;
  engine.view = kView;
  engine.projection = kProjection;
  engine.width_px = 200;
  engine.height_px = 100;
  return engine;
}

Matrix transposed(const Matrix& m) {
  Matrix t;
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) t[4 * r + c] = m[4 * c + r];
  }
  return t;
}

void expect_scene(const EngineCamera& engine, double near_m, double far_m,
                  const glm::dvec2& pixel = kPixel) {
  const Camera camera = camera_of(engine);
  const glm::dvec3 view = to_view(camera, kPoint);
  const glm::dvec2 seen = view_to_pixel(camera, view);
  EXPECT_NEAR(seen.x, pixel.x, 1e-11);  // a few roundings of numbers up to 200
  EXPECT_NEAR(seen.y, pixel.y, 1e-11);
  EXPECT_NEAR(view.z, 6.0, 1e-13);
  // Differences of the projection's numbers, which are 0.02 of them: fifty times their rounding.
  EXPECT_NEAR(camera.near_m, near_m, 1e-13);
  if (std::isinf(far_m)) {
    EXPECT_EQ(camera.far_m, far_m);
  } else {
    EXPECT_NEAR(camera.far_m, far_m, 1e-9);
  }
  // Rays go the way back.
  const glm::dvec3 direction = ray_direction(camera, pixel.x, pixel.y);
  const glm::dvec3 back = camera.eye_m + 6.0 * direction;
  EXPECT_NEAR(glm::length(back - kPoint), 0.0, 1e-12);
}

TEST(EngineCamera, OfOpenGl) { expect_scene(open_gl(), 1.0, 101.0); }

TEST(EngineCamera, InRowMajorLayout) {
  EngineCamera engine = open_gl();
  engine.layout = MatrixLayout::RowMajor;
  engine.view = transposed(kView);
  engine.projection = transposed(kProjection);
  expect_scene(engine, 1.0, 101.0);
}

TEST(EngineCamera, WithRowVectors) {
  EngineCamera engine = open_gl();
  engine.vectors = VectorKind::Row;
  engine.view = transposed(kView);
  engine.projection = transposed(kProjection);
  expect_scene(engine, 1.0, 101.0);
  engine.layout = MatrixLayout::RowMajor;  // transposed twice
  engine.view = kView;
  engine.projection = kProjection;
  expect_scene(engine, 1.0, 101.0);
}

// Left-handed, y up: x east, y up, z north. Rows as Direct3D's tutorials print them.
TEST(EngineCamera, OfDirect3d) {
  EngineCamera engine = open_gl();
  engine.layout = MatrixLayout::RowMajor;
  engine.vectors = VectorKind::Row;
  engine.clip = ClipSpace::Direct3d;
  engine.world_axes = parse_world_axes("x,z,y");
  engine.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -10, -30, -20, 1};
  engine.projection = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1.01, 1, 0, 0, -1.01, 0};
  expect_scene(engine, 1.0, 101.0);
}

// Left-handed, z up, in centimetres: x north, y east.
TEST(EngineCamera, InCentimetres) {
  EngineCamera engine = open_gl();
  engine.layout = MatrixLayout::RowMajor;
  engine.vectors = VectorKind::Row;
  engine.clip = ClipSpace::Direct3d;
  engine.world_axes = parse_world_axes("y,x,z");
  engine.metres_per_unit = 0.01;
  engine.view = {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1000, -3000, -2000, 1};
  engine.projection = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1.01, 1, 0, 0, -101, 0};
  expect_scene(engine, 1.0, 101.0);
}

// Right-handed, y up, as most OpenGL engines are: x east, y up, z south.
TEST(EngineCamera, WithYUp) {
  EngineCamera engine = open_gl();
  engine.world_axes = parse_world_axes("x,-z,y");
  engine.view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -10, -30, 20, 1};
  expect_scene(engine, 1.0, 101.0);
}

TEST(EngineCamera, OfVulkan) {
  EngineCamera engine = open_gl();
  engine.clip = ClipSpace::Vulkan;
  engine.projection = {1, 0, 0, 0, 0, -2, 0, 0, 0, 0, -1.01, -1, 0, 0, -1.01, 0};
  expect_scene(engine, 1.0, 101.0);
}

TEST(EngineCamera, WithReverseDepth) {
  EngineCamera engine = open_gl();
  engine.clip = ClipSpace::Direct3d;
  engine.reverse_z = true;
  engine.projection = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0.01, -1, 0, 0, 1.01, 0};
  expect_scene(engine, 1.0, 101.0);
}

TEST(EngineCamera, WithReverseInfiniteDepth) {
  EngineCamera engine = open_gl();
  engine.clip = ClipSpace::Direct3d;
  engine.reverse_z = true;
  engine.projection = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0};
  expect_scene(engine, 1.0, std::numeric_limits<double>::infinity());
}

TEST(EngineCamera, WithInfiniteDepth) {
  EngineCamera engine = open_gl();
  engine.projection = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0};
  expect_scene(engine, 1.0, std::numeric_limits<double>::infinity());
}

// x / w loses 0.1 of half the window, which is 10 px; y / w gains 0.04 of it, 2 px upwards.
TEST(EngineCamera, OffCentre) {
  EngineCamera engine = open_gl();
  engine.projection[8] = 0.1;
  engine.projection[9] = -0.04;
  expect_scene(engine, 1.0, 101.0, {140.0, 23.0});
}

TEST(EngineCamera, FromAnOriginElsewhere) {
  EngineCamera engine = open_gl();
  engine.view[12] = -10 + 500000.0;  // the engine's origin is far to the east
  engine.world_origin_m = {500000.0, 0.0, 0.0};
  expect_scene(engine, 1.0, 101.0);
}

void expect_refused(const EngineCamera& engine, const std::string& property) {
  try {
    camera_of(engine);
    ADD_FAILURE() << "taken, though " << property;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(property), std::string::npos) << error.what();
  }
}

TEST(EngineCamera, RefusesWhatIsNoPinhole) {
  EngineCamera scaled = open_gl();
  scaled.view[0] = 2.0;
  expect_refused(scaled, "no rigid motion");
  EngineCamera wrong_layout = open_gl();
  wrong_layout.layout = MatrixLayout::RowMajor;
  expect_refused(wrong_layout, "layout or vectors");
  EngineCamera orthographic = open_gl();
  orthographic.projection = {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, -0.02, 0, 0, 0, -1.02, 1};
  expect_refused(orthographic, "orthographic");
  EngineCamera skewed = open_gl();
  skewed.projection[4] = 0.5;
  expect_refused(skewed, "skewed");
  EngineCamera mirrored = open_gl();
  mirrored.world_axes = parse_world_axes("-x,y,z");
  expect_refused(mirrored, "mirrored");
  EngineCamera upside_down = open_gl();
  upside_down.clip = ClipSpace::Vulkan;
  expect_refused(upside_down, "mirrored");
  EngineCamera reversed = open_gl();
  reversed.reverse_z = true;
  expect_refused(reversed, "near plane");
  EngineCamera oblique = open_gl();
  oblique.projection[2] = 0.3;
  expect_refused(oblique, "oblique");
  EngineCamera broken = open_gl();
  broken.view[5] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(broken, "not finite");
  EngineCamera units = open_gl();
  units.metres_per_unit = 0.0;
  expect_refused(units, "metres_per_unit");
}

TEST(WorldAxes, AreReadAndWritten) {
  EXPECT_EQ(to_text(parse_world_axes("x,-z,y")), "x,-z,y");
  EXPECT_EQ(parse_world_axes("+x,y,z"), (std::array<EngineAxis, 3>{{{0, 1}, {1, 1}, {2, 1}}}));
  for (const char* wrong : {"", "x,y", "x,y,y", "x,y,w", "x,y,z,", "xyz"})
    EXPECT_THROW(parse_world_axes(wrong), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace plumb
