// Samples that are projected in lanes have the bits of those that are projected one by one.
#include "audit/project_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "audit/sample_error.h"
#include "core/screen_error.h"
#include "support/random_scene.h"

namespace plumb::audit {
namespace {

using test_support::Random;

struct Row {
  std::vector<float> heights_m;
  std::vector<double> delta_m, triangle;
};

// Heights, voids, deviations of every size, and samples with nothing drawn over them.
Row random_row(Random& random, int count) {
  const auto room = static_cast<std::size_t>(count + SampleRun::kPadding);
  Row row{std::vector<float>(room), std::vector<double>(room), std::vector<double>(room, -1.0)};
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    row.heights_m[k] = random.chance(0.1) ? std::numeric_limits<float>::quiet_NaN()
                                          : static_cast<float>(random.uniform(-300.0, 300.0));
    if (random.chance(0.1)) continue;
    row.triangle[k] = random.integer(0, 5);
    row.delta_m[k] = random.chance(0.2) ? 0.0 : random.uniform(-1.0, 1.0) * random.uniform(0, 400);
  }
  return row;
}

Camera random_view(Random& random) {
  LookAt look;
  look.eye_m = {random.uniform(-500.0, 500.0), random.uniform(-500.0, 500.0),
                random.uniform(-200.0, 600.0)};
  look.target_m = look.eye_m + glm::dvec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                          random.uniform(-1.0, 0.5));
  look.up = {0.1, 0.2, 1.0};
  look.width_px = random.integer(1, 400);
  look.height_px = random.integer(1, 300);
  look.fov_y_deg = random.uniform(20.0, 120.0);
  look.near_m = 0.1;
  return make_camera(look);
}

struct Expected {
  double metres, pixels;
  glm::dvec3 view;
  glm::dvec2 pixel;
};

Expected one_by_one(const Camera& camera, const SampleRun& run, int k) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  Expected expected{kNothing, kNothing, {}, {}};
  const glm::dvec3 point{(run.first + k) * run.dx_m, run.y_m, run.heights_m[k]};
  if (std::isnan(point.z) || run.triangle[k] < 0.0) return expected;
  expected.metres = std::abs(run.delta_m[k]);
  if (!in_frustum(camera, point)) return expected;
  expected.view = to_view(camera, point);
  expected.pixel = view_to_pixel(camera, expected.view);
  expected.pixels =
      screen_displacement_px(camera, point, glm::dvec3(0.0, 0.0, 1.0), run.delta_m[k]);
  return expected;
}

// Equal to the bit, or both NaN.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(ProjectSamples, GivesTheBitsOfOneByOneOnEveryInstructionSet) {
  Random random(91);
  int seen = 0, behind = 0;
  for (int round = 0; round < 2000; ++round) {
    const Camera camera = random_view(random);
    const int count = random.integer(1, ProjectedSamples::kMost);
    const Row row = random_row(random, count);
    const SampleRun run{
        random.uniform(-500.0, 500.0), random.uniform(0.3, 60.0), random.integer(0, 50), count,
        row.heights_m.data(),          row.delta_m.data(),        row.triangle.data()};
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(name_of(set));
      ProjectedSamples projected;
      double pixels_per_metre = 0.0, expected_most = 0.0;
      project_samples(set)(ProjectingCamera(camera), run, projected, pixels_per_metre);
      for (int k = 0; k < count; ++k) {
        const Expected expected = one_by_one(camera, run, k);
        ASSERT_TRUE(same(projected.metres[k], expected.metres)) << k;
        ASSERT_TRUE(same(projected.pixels[k], expected.pixels))
            << projected.pixels[k] << " for " << expected.pixels;
        ASSERT_GE(projected.column[k], 0);
        ASSERT_LT(projected.column[k], camera.width_px);
        ASSERT_GE(projected.row[k], 0);
        ASSERT_LT(projected.row[k], camera.height_px);
        if (std::isnan(expected.pixels)) continue;
        ++seen;
        behind += std::isinf(expected.pixels);
        EXPECT_TRUE(same(projected.depth_m[k], expected.view.z));
        EXPECT_EQ(projected.column[k],
                  std::min(static_cast<int>(expected.pixel.x), camera.width_px - 1));
        EXPECT_EQ(projected.row[k],
                  std::min(static_cast<int>(expected.pixel.y), camera.height_px - 1));
        const double small = 1e-6 * expected.view.z;
        const glm::dvec3 up = direction_to_view(camera, {0.0, 0.0, 1.0});
        expected_most = std::max(
            expected_most, screen_displacement_at_speed_px(screen_speed(camera, expected.view, up),
                                                           expected.view.z, up.z, small) /
                               small);
      }
      EXPECT_TRUE(same(pixels_per_metre, expected_most));
    }
  }
  EXPECT_GT(seen, 2000);
  EXPECT_GT(behind, 20);
}

}  // namespace
}  // namespace plumb::audit
