#include "core/screen_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace plumb {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

class Random {
 public:
  double between(double low, double high) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 42;
};

Camera random_camera(Random& random) {
  LookAt look;
  look.eye_m = {random.between(-200, 200), random.between(-200, 200), random.between(1, 300)};
  look.target_m = {random.between(-200, 200), random.between(-200, 200), random.between(-50, 50)};
  look.fov_y_deg = random.between(20, 100);
  look.width_px = 640;
  look.height_px = 360;
  return make_camera(look);
}

Box random_box(Random& random) {
  Box box;
  const glm::dvec3 a{random.between(-300, 300), random.between(-300, 300), random.between(-20, 60)};
  box.add(a);
  box.add(a + glm::dvec3(random.between(0, 120), random.between(0, 120), random.between(0, 40)));
  return box;
}

double moved_on_screen(const Camera& camera, const glm::dvec3& p, double delta) {
  const glm::dvec3 a = to_view(camera, p), b = to_view(camera, p + delta * kUp);
  if (!(a.z > 0) || !(b.z > 0)) return std::numeric_limits<double>::infinity();
  const glm::dvec2 d = view_to_pixel(camera, a) - view_to_pixel(camera, b);
  return std::sqrt(glm::dot(d, d));
}

bool seen(const Camera& camera, const glm::dvec3& p) {
  const glm::dvec3 view = to_view(camera, p);
  if (view.z < camera.near_m) return false;
  const glm::dvec2 pixel = view_to_pixel(camera, view);
  return pixel.x >= 0 && pixel.x <= camera.width_px && pixel.y >= 0 && pixel.y <= camera.height_px;
}

TEST(ScreenDisplacement, IsTheDistanceOfTheProjections) {
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const Camera camera = random_camera(random);
    const glm::dvec3 p{random.between(-300, 300), random.between(-300, 300),
                       random.between(-20, 60)};
    const double delta = random.between(-20, 20), expected = moved_on_screen(camera, p, delta);
    const double found = screen_displacement_px(camera, p, kUp, delta);
    if (std::isinf(expected)) {
      EXPECT_EQ(found, expected);
    } else if (expected < 1e6) {
      // Pixels of both projections round at their magnitude.
      EXPECT_NEAR(found, expected, 1e-9 * (1.0 + expected));
    }
  }
}

TEST(ScreenDisplacement, OfNothingIsZero) {
  EXPECT_EQ(screen_displacement_px(Camera{}, {0, -5, 0}, kUp, 0.0), 0.0);
}

// The papers' gamma * error / distance is no bound: at the corner of a 16:9 image 60 degrees high a
// vertical length spans more. By hand: with t = tan 30 and a slope of (16/9 t, t), the distance is
// sqrt(1 + (16/9 t)^2 + t^2) = 1.541 times the depth, and the length's image N / w = gamma (e at
// right angles to the view's axis), so the ratio is 1.541.
TEST(ScreenDisplacement, AtTheCornerOfTheImageIsMoreThanTheDistanceTells) {
  LookAt look;
  look.fov_y_deg = 60.0;
  look.target_m = {0, 1, 0};
  const Camera camera = make_camera(look);
  const glm::dvec3 p = 100.0 * ray_direction(camera, 0.0, 0.0);
  const double distance = std::sqrt(glm::dot(p, p)), small = 1e-4, third = 1.0 / 3.0;
  const double ratio =
      screen_displacement_px(camera, p, kUp, small) / (camera.gamma_v * small / distance);
  EXPECT_NEAR(ratio, std::sqrt(1.0 + 256.0 / 81.0 * third + third), 1e-9);
}

TEST(LargestDisplacement, IsReachedAndNeverExceeded) {
  Random random;
  int finite = 0;
  for (int k = 0; k < 1500; ++k) {
    const Camera camera = random_camera(random);
    const Box box = random_box(random);
    const double delta = random.between(0.1, 15);
    const double bound = largest_displacement_px(camera, box, kUp, delta);
    if (std::isinf(bound)) continue;
    ++finite;
    double largest = 0.0;
    constexpr int kSteps = 12;
    for (int a = 0; a <= kSteps; ++a) {
      for (int b = 0; b <= kSteps; ++b) {
        for (int c = 0; c <= 2; ++c) {
          const glm::dvec3 share{a / double(kSteps), b / double(kSteps), c / 2.0};
          const glm::dvec3 p = box.low + share * (box.high - box.low);
          for (const double d : {delta, -delta})
            largest = std::max(largest, moved_on_screen(camera, p, d));
        }
      }
    }
    EXPECT_LE(largest, bound * (1 + 1e-9));
    // The grid meets corners exactly and edges to a twelfth: near the largest.
    if (bound < 1e4) {
      EXPECT_GE(largest, 0.9 * bound);
    }
  }
  EXPECT_GT(finite, 300);
}

TEST(AllowedDisplacement, KeepsEveryPointInViewWithinTheError) {
  Random random;
  int looked_at = 0;
  for (int k = 0; k < 4000; ++k) {
    const Camera camera = random_camera(random);
    const Box box = random_box(random);
    const double error = random.between(0.1, 8);
    const double allowed = allowed_displacement_m(camera, box, kUp, error);
    ASSERT_GE(allowed, 0.0);
    for (int sample = 0; sample < 30; ++sample) {
      const glm::dvec3 share{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
      const glm::dvec3 p = box.low + share * (box.high - box.low);
      if (!seen(camera, p)) continue;
      ASSERT_TRUE(std::isfinite(allowed));
      ++looked_at;
      for (const double d : {allowed, -allowed})
        EXPECT_LE(moved_on_screen(camera, p, d), error * (1 + 1e-9));
    }
  }
  EXPECT_GT(looked_at, 1000);
}

TEST(AllowedDisplacement, IsFiniteAroundTheEye) {
  const Camera camera = make_camera({.eye_m = {0, 0, 10}, .target_m = {0, 100, 0}});
  Box box;
  box.add({-50, -50, 0});
  box.add({50, 50, 20});
  const double allowed = allowed_displacement_m(camera, box, kUp, 1.0);
  EXPECT_GT(allowed, 0.0);
  EXPECT_LT(allowed, 0.01);  // ground a hand's breadth before the lens allows nothing else
}

TEST(MayBeInView, NeverLosesAPointThatIsSeen) {
  Random random;
  int hidden = 0;
  for (int k = 0; k < 4000; ++k) {
    const Camera camera = random_camera(random);
    const Box box = random_box(random);
    if (may_be_in_view(camera, box)) continue;
    ++hidden;
    for (int sample = 0; sample < 30; ++sample) {
      const glm::dvec3 share{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
      EXPECT_FALSE(seen(camera, box.low + share * (box.high - box.low)));
    }
  }
  EXPECT_GT(hidden, 500);
}

}  // namespace
}  // namespace plumb
