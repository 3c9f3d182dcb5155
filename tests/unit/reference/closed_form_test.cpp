// Scenes whose answer can be computed by hand, for every caster that casts frames at heightfields.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/reproducible_math.h"
#include "reference/embree_caster.h"
#include "reference/pyramid_caster.h"
#include "support/brute_force_caster.h"
#include "support/hit_image_difference.h"
#include "terrain/heightfield.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr Diagonal kDiagonals[] = {Diagonal::Alternating, Diagonal::Fixed, Diagonal::Blocks8};

struct Caster {
  const char* name;
  std::function<HitImage(const Heightfield&, Diagonal, const Camera&)> cast;

  friend std::ostream& operator<<(std::ostream& out, const Caster& c) { return out << c.name; }
};

const Caster kCasters[] = {
    {"embree",
     [](const Heightfield& field, Diagonal diagonal, const Camera& camera) {
       return EmbreeCaster(field, diagonal).cast_frame(camera);
     }},
    {"pyramid",
     [](const Heightfield& field, Diagonal diagonal, const Camera& camera) {
       return PyramidCaster(field, diagonal).cast_frame(camera);
     }},
};

class ClosedForm : public testing::TestWithParam<Caster> {
 protected:
  HitImage cast(const Heightfield& field, Diagonal diagonal, const Camera& camera) const {
    return GetParam().cast(field, diagonal, camera);
  }
};

INSTANTIATE_TEST_SUITE_P(Casters, ClosedForm, testing::ValuesIn(kCasters),
                         testing::PrintToStringParamName());

// 33 x 33 samples, 10 m apart, in UTM coordinates with odd digits; heights from height(i, j).
template <class Height>
Heightfield field_of(const Height& height) {
  Heightfield field;
  field.heights_m = Grid<float>(33, 33);
  field.dx_m = field.dy_m = 10.0;
  field.origin_m = {500317.129, 4500891.733};
  for (int j = 0; j < 33; ++j) {
    for (int i = 0; i < 33; ++i) field.heights_m.floats()(i, j) = static_cast<float>(height(i, j));
  }
  return field;
}

// From (x, y, z) towards (tx, ty, tz), both relative to the terrain's origin.
Camera camera_at(const Heightfield& field, const glm::dvec3& eye, const glm::dvec3& target) {
  LookAt look;
  look.eye_m = field.world_origin_m() + eye;
  look.target_m = field.world_origin_m() + target;
  look.width_px = 41;  // odd, so that a ray runs straight at the target
  look.height_px = 31;
  return make_camera(look);
}

struct PixelRay {
  glm::dvec3 origin, direction;  // relative to the terrain's origin
};

// Calls check(pixel, ray) for each pixel.
template <class Check>
void for_each_pixel(const Heightfield& field, const Camera& camera, const Check& check) {
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      check(
          static_cast<std::size_t>(y) * camera.width_px + x,
          PixelRay{camera.eye_m - field.world_origin_m(), ray_direction(camera, x + 0.5, y + 0.5)});
    }
  }
}

// A plane z = base + a x + b y over the terrain's square: the ray meets it at one t, and hits if it
// is there within the square. A millimetre about the border is left to the rounding of the digits
// of an eye in UTM coordinates (1e-9 m).
void expect_plane(const Heightfield& field, const HitImage& image, const Camera& camera,
                  double base, double a, double b) {
  std::size_t hits = 0;
  for_each_pixel(field, camera, [&](std::size_t pixel, const PixelRay& ray) {
    const double above = ray.origin.z - (base + a * ray.origin.x + b * ray.origin.y);
    const double fall = a * ray.direction.x + b * ray.direction.y - ray.direction.z;
    const double t = above / fall;
    const glm::dvec3 p = ray.origin + t * ray.direction;
    const double inside = std::min({p.x, p.y, 320.0 - p.x, 320.0 - p.y});
    if (std::abs(inside) < 1e-3) return;
    const bool expected = fall != 0.0 && t >= camera.near_m && inside > 0.0;
    ASSERT_EQ(image.hit(pixel), expected) << pixel;
    if (!expected) return;
    ++hits;
    // The eye's height above the plane carries its digits' 1e-9 m; all else is 1e-12 of t.
    ASSERT_NEAR(image.depth_m[pixel], t, 1e-12 * t + 2e-9 / std::abs(fall)) << pixel;
    ASSERT_EQ(image.from_eye_m[pixel], image.depth_m[pixel] * ray.direction);
  });
  EXPECT_GT(hits, image.size() / 16);
}

TEST_P(ClosedForm, PlaneIsWhereItsEquationSays) {
  const Heightfield field = field_of([](int, int) { return 100.0; });
  for (const glm::dvec3& eye : {glm::dvec3{163.1, -40.7, 210.3},
                                {161.3, 158.2, 900.1},
                                {150.2, 101.1, 101.7},
                                {90.3, 80.2, -77.7}}) {
    const Camera camera = camera_at(field, eye, {160.0, 165.0, 100.0});
    for (const Diagonal diagonal : kDiagonals) {
      expect_plane(field, cast(field, diagonal, camera), camera, 100.0, 0.0, 0.0);
    }
  }
}

// z = 20 + x / 4 - y / 2: heights that float32 holds exactly.
TEST_P(ClosedForm, TiltedPlaneIsWhereItsEquationSays) {
  const Heightfield field = field_of([](int i, int j) { return 20.0 + 2.5 * i - 5.0 * j; });
  for (const glm::dvec3& eye : {glm::dvec3{163.1, -90.7, 310.3}, {161.3, 158.2, 900.1}}) {
    const Camera camera = camera_at(field, eye, {160.0, 165.0, 0.0});
    for (const Diagonal diagonal : kDiagonals) {
      expect_plane(field, cast(field, diagonal, camera), camera, 20.0, 0.25, -0.5);
    }
  }
}

// Every pixel against all triangles in long double: the same triangle at the same place.
void expect_brute_force(const Caster& caster, const Heightfield& field, const glm::dvec3& eye,
                        const glm::dvec3& target) {
  const Camera camera = camera_at(field, eye, target);
  for (const Diagonal diagonal : kDiagonals) {
    const HitImage truth = test_support::brute_force_frame<long double>(
        camera, field.world_origin_m(),
        [&](const auto& ray) { return test_support::brute_force(field, diagonal, ray); });
    const auto d = test_support::difference(camera, truth, caster.cast(field, diagonal, camera));
    EXPECT_GT(d.hits, d.pixels / 8) << name_of(diagonal);
    EXPECT_EQ(d.hit_or_miss + d.elsewhere + d.primitive, 0u)
        << name_of(diagonal) << ": " << to_text(d);
  }
}

double paraboloid(double x, double y) { return (x * x + y * y) / 640.0; }

// A chord of a parabola with second derivative c lies c/8 h^2 above its middle; both directions
// together: at most (1/320) * (10^2 + 10^2) / 8 m, and never below the paraboloid.
TEST_P(ClosedForm, ParaboloidIsMetNoFarAboveItself) {
  const Heightfield field =
      field_of([](int i, int j) { return paraboloid(10.0 * i - 160.0, 10.0 * j - 160.0); });
  const Camera camera = camera_at(field, {163.1, -90.7, 310.3}, {160.0, 165.0, 0.0});
  const double chord = (200.0 / 320.0) / 8.0;
  const double rounding = 80.0 * 0x1p-24;  // of a height in float32
  for (const Diagonal diagonal : kDiagonals) {
    const HitImage image = cast(field, diagonal, camera);
    std::size_t hits = 0;
    for_each_pixel(field, camera, [&](std::size_t pixel, const PixelRay& ray) {
      if (!image.hit(pixel)) return;
      ++hits;
      const glm::dvec3 p = ray.origin + image.from_eye_m[pixel];
      const double above = p.z - paraboloid(p.x - 160.0, p.y - 160.0);
      EXPECT_GE(above, -rounding - 1e-9);
      EXPECT_LE(above, chord + rounding + 1e-9);
    });
    EXPECT_GT(hits, image.size() / 4);
  }
  expect_brute_force(GetParam(), field, {163.1, -90.7, 310.3}, {160.0, 165.0, 0.0});
}

// West of column 16 at 0 m, from there on at 50 m: one column of cells is a ramp. A level ray at
// 25 m meets it half way, at x = 155; one at 49 m, a fiftieth before x = 160.
TEST_P(ClosedForm, StepIsMetWhereTheRampStands) {
  const Heightfield field = field_of([](int i, int) { return i < 16 ? 0.0 : 50.0; });
  for (const double height : {25.0, 49.0, 1.0}) {
    const Camera camera = camera_at(field, {20.0, 163.0, height}, {160.0, 163.0, height});
    const double expected = 150.0 + 10.0 * height / 50.0 - 20.0;
    for (const Diagonal diagonal : kDiagonals) {
      const HitImage image = cast(field, diagonal, camera);
      EXPECT_NEAR(image.depth_m[image.index(20, 15)], expected, 1e-8);  // the eye's digits
    }
  }
  expect_brute_force(GetParam(), field, {21.7, 163.0, 70.3}, {160.0, 163.0, 25.0});
}

// One sample at 100 m in a level terrain. The pyramid's sides fall to the neighbours: seen along
// the row, a ray at height z meets the spike (100 - z) / 100 cells before its axis. A ray above the
// tip passes; one through the tip is a rounding's choice and not asked.
TEST_P(ClosedForm, SpikeIsMetOnItsSide) {
  const Heightfield field = field_of([](int i, int j) { return i == 16 && j == 16 ? 100.0 : 0.0; });
  for (const double height : {1.0, 50.0, 99.0, 99.999}) {
    const Camera camera = camera_at(field, {20.0, 160.0, height}, {160.0, 160.0, height});
    for (const Diagonal diagonal : kDiagonals) {
      const HitImage image = cast(field, diagonal, camera);
      const double expected = 160.0 - 10.0 * (100.0 - height) / 100.0 - 20.0;
      EXPECT_NEAR(image.depth_m[image.index(20, 15)], expected, 1e-8) << height;
    }
  }
  const Camera above = camera_at(field, {20.0, 160.0, 100.001}, {160.0, 160.0, 100.001});
  EXPECT_FALSE(cast(field, Diagonal::Fixed, above).hit(20 + 15 * 41));
  expect_brute_force(GetParam(), field, {25.3, 22.9, 60.2}, {160.0, 160.0, 20.0});
}

TEST_P(ClosedForm, SinusoidIsTheTriangleThatBruteForceFinds) {
  const Heightfield field = field_of(
      [](int i, int j) { return 30.0 * reproducible_sin(0.6 * i) * reproducible_cos(0.45 * j); });
  expect_brute_force(GetParam(), field, {163.1, -20.7, 60.3}, {160.0, 165.0, 0.0});
  expect_brute_force(GetParam(), field, {161.3, 158.2, 8.1}, {20.0, 300.0, 5.0});
}

TEST_P(ClosedForm, CheckerboardIsTheTriangleThatBruteForceFinds) {
  const Heightfield field = field_of([](int i, int j) { return (i + j) % 2 ? 20.0 : 0.0; });
  expect_brute_force(GetParam(), field, {163.1, -20.7, 120.3}, {160.0, 165.0, 0.0});
  expect_brute_force(GetParam(), field, {161.3, 158.2, 500.1}, {160.0, 165.0, 0.0});
}

TEST_P(ClosedForm, VoidsAreOpen) {
  const Heightfield field = field_of([](int i, int j) {
    return (i * 7 + j * 5) % 11 == 0 ? std::nan("") : 3.0 * ((i * 3 + j * 2) % 5);
  });
  expect_brute_force(GetParam(), field, {163.1, -20.7, 120.3}, {160.0, 165.0, 0.0});
  expect_brute_force(GetParam(), field, {161.3, 158.2, -90.1}, {160.0, 165.0, 0.0});
}

}  // namespace
}  // namespace plumb::reference
