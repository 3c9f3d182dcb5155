#include "core/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumb {
namespace {

// 90 degrees high over 100 pixels: a unit at depth one spans 50 pixels.
Camera square_camera() {
  LookAt look;
  look.eye_m = {10.0, 20.0, 30.0};
  look.target_m = {10.0, 21.0, 30.0};
  look.fov_y_deg = 90.0;
  look.width_px = 200;
  look.height_px = 100;
  return make_camera(look);
}

TEST(Camera, LooksNorthWithEastToTheRight) {
  const Camera camera = square_camera();
  EXPECT_EQ(camera.right, glm::dvec3(1, 0, 0));
  EXPECT_EQ(camera.up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(camera.forward, glm::dvec3(0, 1, 0));
  EXPECT_NEAR(camera.gamma_v, 50.0, 1e-13);
  EXPECT_EQ(camera.gamma_h, camera.gamma_v);
}

TEST(Camera, SeesAPointWhereItShould) {
  const Camera camera = square_camera();
  // Two metres ahead, one to the right, half a metre up: 25 px right of and 12.5 px above the
  // middle.
  const glm::dvec3 view = to_view(camera, {11.0, 22.0, 30.5});
  EXPECT_EQ(view, glm::dvec3(1.0, 0.5, 2.0));
  const glm::dvec2 pixel = view_to_pixel(camera, view);
  EXPECT_NEAR(pixel.x, 125.0, 1e-12);
  EXPECT_NEAR(pixel.y, 37.5, 1e-12);
}

TEST(Camera, SendsRaysThroughThePixelThatTheyAreSeenIn) {
  LookAt look;
  look.eye_m = {512345.6, 4512345.6, 812.25};
  look.target_m = {513345.6, 4511345.6, 112.0};
  Camera camera = make_camera(look);
  camera.centre_px += glm::dvec2(0.25, -3.5);  // jitter
  for (const glm::dvec2 pixel :
       {glm::dvec2(0.5, 0.5), glm::dvec2(1919.5, 1079.5), glm::dvec2(700.25, 33.0)}) {
    const glm::dvec3 direction = ray_direction(camera, pixel.x, pixel.y);
    EXPECT_NEAR(glm::dot(direction, camera.forward), 1.0, 1e-15);
    const glm::dvec3 view{glm::dot(direction, camera.right), glm::dot(direction, camera.up),
                          glm::dot(direction, camera.forward)};
    // Twenty roundings of numbers up to 2000.
    EXPECT_NEAR(view_to_pixel(camera, view).x, pixel.x, 1e-11);
    EXPECT_NEAR(view_to_pixel(camera, view).y, pixel.y, 1e-11);
  }
}

TEST(Camera, LooksStraightDownWithNorthUp) {
  LookAt look;
  look.eye_m = {0, 0, 100};
  look.target_m = {0, 0, 0};
  const Camera camera = make_camera(look);
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(camera.right, glm::dvec3(1, 0, 0));
}

TEST(Camera, RefusesWhatIsNoCamera) {
  const auto refuses = [](auto change) {
    LookAt look;
    change(look);
    EXPECT_THROW(make_camera(look), std::invalid_argument);
  };
  refuses([](LookAt& l) { l.target_m = l.eye_m; });
  refuses([](LookAt& l) { l.fov_y_deg = 0.0; });
  refuses([](LookAt& l) { l.fov_y_deg = 180.0; });
  refuses([](LookAt& l) { l.width_px = 0; });
  refuses([](LookAt& l) { l.near_m = 0.0; });
  refuses([](LookAt& l) { l.far_m = 0.05; });
  refuses([](LookAt& l) { l.up = {0, 0, 0}; });
  refuses([](LookAt& l) { l.eye_m.x = std::numeric_limits<double>::quiet_NaN(); });
}

}  // namespace
}  // namespace plumb
