// What a stored number stands for, and that its rounding breaks no claim.
#include "audit/depth_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "audit/audit.h"
#include "core/check.h"
#include "support/stranger_frames.h"

namespace plumb::audit {
namespace {

using test_support::decimated;
using test_support::Ground;
using test_support::ground;
using test_support::noise;
using test_support::stored_number;
using test_support::written;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Camera planes(double near_m, double far_m) {
  Camera camera;
  camera.near_m = near_m;
  camera.far_m = far_m;
  return camera;
}

DepthRange range_of(double stored, DepthConvention convention, const Camera& camera,
                    const image::NumberFormat& format = {}) {
  return depth_range(static_cast<float>(stored), format, {convention}, camera, 1.0).value();
}

// 1/w = (1 - d)/n + d/f: with n = 1 and f = 4, d = 2/3 is 1/3 + 1/6 = 1/2.
TEST(DepthMeaning, ReadsWindowDepth) {
  const Camera camera = planes(1.0, 4.0);
  EXPECT_NEAR(range_of(2.0 / 3.0, DepthConvention::Window, camera).value, 2.0, 1e-6);
  EXPECT_NEAR(range_of(1.0 / 3.0, DepthConvention::Ndc, camera).value, 2.0, 1e-6);
  EXPECT_NEAR(range_of(1.0 / 3.0, DepthConvention::ReverseZ, camera).value, 2.0, 1e-6);
  EXPECT_EQ(range_of(0.0, DepthConvention::Window, camera).value, 1.0);
  EXPECT_EQ(range_of(1.0, DepthConvention::ReverseZ, camera).value, 1.0);
}

TEST(DepthMeaning, TakesAnInfiniteFarPlane) {
  const Camera camera = planes(0.5, kInfinity);
  EXPECT_EQ(range_of(0.75, DepthConvention::Window, camera).value, 2.0);
  EXPECT_EQ(range_of(0.25, DepthConvention::ReverseZ, camera).value, 2.0);
  EXPECT_EQ(range_of(0.5, DepthConvention::Ndc, camera).value, 2.0);
}

TEST(DepthMeaning, TakesClearedNumbersForSky) {
  const Camera camera = planes(1.0, 4.0);
  EXPECT_TRUE(range_of(1.0, DepthConvention::Window, camera).is_sky());
  EXPECT_TRUE(range_of(1.0, DepthConvention::Ndc, camera).is_sky());
  EXPECT_TRUE(range_of(0.0, DepthConvention::ReverseZ, camera).is_sky());
  EXPECT_TRUE(range_of(kInfinity, DepthConvention::Linear, camera).is_sky());
  EXPECT_TRUE(range_of(kInfinity, DepthConvention::Distance, camera).is_sky());
  DepthMeaning zero;
  zero.sky = 0.0;
  EXPECT_TRUE(depth_range(0.0f, {}, zero, camera, 1.0)->is_sky());
}

TEST(DepthMeaning, RefusesNumbersThatAreNoDepths) {
  const Camera camera = planes(1.0, 4.0);
  const auto is_none = [&](double stored, DepthConvention convention) {
    return !depth_range(static_cast<float>(stored), {}, {convention}, camera, 1.0);
  };
  for (const double bad : {0.0, -1.0, -kInfinity, std::nan("")})
    EXPECT_TRUE(is_none(bad, DepthConvention::Linear)) << bad;
  for (const double bad : {-0.1, 1.1, kInfinity, std::nan("")})
    EXPECT_TRUE(is_none(bad, DepthConvention::Window)) << bad;
  EXPECT_TRUE(is_none(-1.1, DepthConvention::Ndc));
  EXPECT_FALSE(is_none(-0.9, DepthConvention::Ndc));
}

TEST(DepthMeaning, DividesDistanceByTheRaysLength) {
  EXPECT_EQ(depth_range(10.0f, {}, {DepthConvention::Distance}, Camera{}, 1.25)->value, 8.0);
  const DepthMeaning feet{DepthConvention::Linear, false, false, 0.25};
  EXPECT_EQ(depth_range(10.0f, {}, feet, Camera{}, 1.25)->value, 2.5);
}

// Between 1/2 and 1 singles lie 2^-24 apart, halves 2^-11; above 1 twice as far.
TEST(NumberFormat, KnowsHowFarNumbersLieApart) {
  const auto half_widths = [](double value, const image::NumberFormat& format) {
    const image::NumberRange held = image::numbers_held_as(value, format);
    return std::pair{value - held.low, held.high - value};
  };
  const double single = std::ldexp(1.0, -25), half = std::ldexp(1.0, -12);
  EXPECT_EQ(half_widths(0.75, {}), (std::pair{single, single}));
  EXPECT_EQ(half_widths(1.0, {}), (std::pair{single, 2.0 * single}));
  EXPECT_EQ(half_widths(-1.0, {}), (std::pair{2.0 * single, single}));
  EXPECT_EQ(half_widths(0.75, {11, 0}), (std::pair{half, half}));
  EXPECT_NEAR(half_widths(1.0 / 3.0, {24, 2}).first, 0.5 / 3.0, std::ldexp(1.0, -24));
}

// Stored numbers of every format: the depth that was rounded lies in the range.
double rounded(double value, const image::NumberFormat& format) {
  if (format.step_bits > 0) {
    const double steps = std::ldexp(1.0, format.step_bits) - 1.0;
    return static_cast<float>(std::nearbyint(value * steps) / steps);
  }
  if (format.float_digits == 24) return static_cast<float>(value);
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  const double ulp = std::ldexp(1.0, -format.float_digits);
  return std::ldexp(std::nearbyint(fraction / ulp) * ulp, exponent);
}

constexpr DepthConvention kConventions[] = {DepthConvention::Linear, DepthConvention::Distance,
                                            DepthConvention::Window, DepthConvention::Ndc,
                                            DepthConvention::ReverseZ};

TEST(DepthMeaning, HoldsEveryDepthInItsOwnRange) {
  for (const double far_m : {20000.0, kInfinity}) {
    const Camera camera = planes(0.3, far_m);
    for (const DepthConvention convention : kConventions) {
      for (const image::NumberFormat& format : {image::NumberFormat{}, {11, 0}, {24, 16}}) {
        const bool is_linear =
            convention == DepthConvention::Linear || convention == DepthConvention::Distance;
        if (format.step_bits > 0 && (is_linear || convention == DepthConvention::Ndc)) continue;
        for (int k = 0; k < 2000; ++k) {
          const double depth = 0.31 + 15000.0 * noise(1, k, 0) * noise(2, k, 0);
          const double number = rounded(stored_number(depth, 1.25, {convention}, camera), format);
          const auto range =
              depth_range(static_cast<float>(number), format, {convention}, camera, 1.25);
          ASSERT_TRUE(range) << number;
          // The number was itself computed with a rounding or two.
          EXPECT_LE(range->low, depth * (1.0 + 1e-9)) << name_of(convention);
          EXPECT_GE(range->high, depth * (1.0 - 1e-9)) << name_of(convention);
        }
      }
    }
  }
}

AuditOptions with_band(double pixels) {
  AuditOptions options;
  options.band.pixels = pixels;
  options.nearest = false;
  return options;
}

struct Judged {
  AuditResult exact, read;
};

// A coarse surface judged by its own doubles, and from a buffer that rounds them.
Judged judged(const Ground& there, const HitImage& drawn, const Camera& camera,
              DepthConvention convention, const image::NumberFormat& format) {
  HitImage given = drawn;
  std::replace_if(
      given.primitive.begin(), given.primitive.end(), [](auto p) { return p != kNoPrimitive; }, 0u);
  const HitImage hits = there.truth.caster.cast_frame(camera);
  DrawnSurface surface = surface_of(given);
  AuditResult first = audit_picture(there.truth, hits, surface, given, camera, with_band(0.0));
  const AuditOptions options = with_band(first.pixels.max_vertical_px);
  surface.claims = {{Measure::PixelError, first.pixels.max_vertical_px, Unit::Pixel}};
  Judged result{audit_picture(there.truth, hits, surface, given, camera, options), {}};
  image::DepthBuffer buffer = written(drawn, camera, {convention});
  for (float& value : buffer.values)
    if (std::isfinite(value)) value = static_cast<float>(rounded(value, format));
  buffer.format = format;
  const DepthPicture picture =
      depth_picture(there.truth, hits, buffer, {convention}, camera, options.band);
  EXPECT_EQ(picture.no_depths, 0);
  result.read = audit_picture(there.truth, hits, surface, picture.image, camera, options);
  return result;
}

// A near plane of 10 cm leaves 16 bits next to nothing at a distance: ranges of kilometres.
TEST(DepthPicture, BreaksNoClaimByTheBuffersRounding) {
  for (const char* terrain :
       {"generate:alpine?size=129&seed=7", "generate:urban?size=129&seed=3"}) {
    const auto there = ground(terrain);
    for (const char* preset : {"oblique", "valley"}) {
      for (const int stride : {1, 2, 8}) {
        Camera camera = there->camera(preset, 97, 61);
        camera.near_m = 0.1;
        const HitImage drawn = decimated(there->field, stride)->truth.caster.cast_frame(camera);
        for (const image::NumberFormat& format :
             {image::NumberFormat{}, {11, 0}, {24, 16}, {24, 24}}) {
          const Judged both = judged(*there, drawn, camera, DepthConvention::Window, format);
          EXPECT_TRUE(both.exact.claims.front().holds);
          EXPECT_TRUE(both.read.claims.front().holds)
              << terrain << preset << stride << image::to_text(format) << " "
              << both.read.pixels.max_vertical_px << " > " << both.exact.pixels.max_vertical_px;
          EXPECT_LE(both.read.coverage.defect_count(), both.exact.coverage.defect_count())
              << terrain << preset << stride << image::to_text(format) << " holes "
              << both.read.coverage.holes << " over " << both.read.coverage.overshoots << " see "
              << both.read.coverage.see_through << " band " << both.exact.pixels.max_vertical_px;
        }
      }
    }
  }
}

// Singles of view depth are known to a part in 10^7, and so are errors.
TEST(DepthPicture, MeasuresWhatTheDoublesSay) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  const Camera camera = there->camera("oblique", 97, 61);
  const HitImage drawn = decimated(there->field, 8)->truth.caster.cast_frame(camera);
  for (const DepthConvention convention : {DepthConvention::Linear, DepthConvention::Distance}) {
    const Judged both = judged(*there, drawn, camera, convention, {});
    EXPECT_GT(both.exact.pixels.max_vertical_px, 1.0);
    // 2^-24 of 10 km, a tangent of a few, and a pixel to some metres.
    EXPECT_NEAR(both.read.pixels.max_vertical_px, both.exact.pixels.max_vertical_px, 1e-2);
    EXPECT_NEAR(both.read.vertical.rms, both.exact.vertical.rms, 1e-4);
  }
}

image::DepthBuffer in_16_bits(const HitImage& hits, const Camera& camera) {
  image::DepthBuffer buffer = written(hits, camera, {DepthConvention::Window});
  buffer.format = {24, 16};
  for (float& value : buffer.values) value = static_cast<float>(rounded(value, buffer.format));
  return buffer;
}

TEST(DepthPicture, TellsWhatRoundingHides) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  Camera camera = there->camera("oblique", 97, 61);
  camera.near_m = 1.0;
  camera.far_m = kInfinity;
  const HitImage hits = there->truth.caster.cast_frame(camera);
  const image::DepthBuffer buffer = in_16_bits(hits, camera);
  const DepthPicture picture =
      depth_picture(there->truth, hits, buffer, {DepthConvention::Window}, camera, {});
  // Half a step h is h w^2 / n metres: the header's derivation.
  const std::vector<double>& depths = hits.depth_m;
  double farthest = 0.0;
  for (const double depth : depths)
    if (depth < kNoHit) farthest = std::max(farthest, depth);
  EXPECT_NEAR(picture.largest_rounding_m, 0.5 / 65535.0 * farthest * farthest,
              0.2 * picture.largest_rounding_m);
  EXPECT_NE(rounding_text(picture, buffer.format).find("steps of 1/65535"), std::string::npos);
}

// Depths of the sky's own number may be terrain beyond what the buffer tells: 0.1 m and 16 bits end
// at 0.1 * 2 * 65535 m = 13 km; at 1 mm they end at 131 m.
TEST(DepthPicture, DoesNotHoldClearedNumbersAgainstFarTerrain) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  Camera camera = there->camera("oblique", 97, 61);
  camera.near_m = 0.001;
  camera.far_m = kInfinity;
  const HitImage hits = there->truth.caster.cast_frame(camera);
  const image::DepthBuffer buffer = in_16_bits(hits, camera);
  const DepthPicture picture =
      depth_picture(there->truth, hits, buffer, {DepthConvention::Window}, camera, {});
  EXPECT_GT(picture.undecided, 100);
  EXPECT_EQ(picture.image.depth_m, hits.depth_m);
}

TEST(DepthPicture, CountsWhatIsNoDepth) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  const Camera camera = there->camera("oblique", 97, 61);
  const HitImage hits = there->truth.caster.cast_frame(camera);
  image::DepthBuffer buffer = written(hits, camera, {});
  buffer.values[97 * 3 + 5] = -2.0f;
  buffer.values[97 * 4 + 1] = 0.0f;
  const DepthPicture picture = depth_picture(there->truth, hits, buffer, {}, camera, {});
  EXPECT_EQ(picture.no_depths, 2);
  EXPECT_EQ(picture.first_x, 5);
  EXPECT_EQ(picture.first_y, 3);
  EXPECT_EQ(picture.first_number, -2.0f);
}

TEST(DepthPicture, RefusesAnotherSize) {
  const auto there = ground("generate:alpine?size=33&seed=7");
  const Camera camera = there->camera("oblique", 16, 9);
  const HitImage hits = there->truth.caster.cast_frame(camera);
  EXPECT_THROW(
      depth_picture(there->truth, hits, written(HitImage(9, 16), camera, {}), {}, camera, {}),
      std::invalid_argument);
}

// An eye below the ground sees undersides, which a solid has not; a sheet has them.
TEST(DepthPicture, SetsNothingOfASheetAside) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  Camera camera = there->camera("oblique", 97, 61);
  camera.eye_m.z = -2000.0;
  camera.forward = glm::dvec3(0.0, 0.0, 1.0);
  camera.up = glm::dvec3(0.0, 1.0, 0.0);
  camera.right = glm::dvec3(-1.0, 0.0, 0.0);
  camera.eye_m.x = camera.eye_m.y = 640.0;
  const HitImage hits = there->truth.caster.cast_frame(camera);
  HitImage torn = hits;
  std::replace_if(
      torn.primitive.begin(), torn.primitive.end(), [](auto p) { return p != kNoPrimitive; }, 0u);
  const std::size_t middle = torn.index(48, 30);
  ASSERT_TRUE(torn.hit(middle));
  torn.depth_m[middle] *= 0.5;
  torn.from_eye_m[middle] *= 0.5;
  DrawnSurface surface = surface_of(torn);
  const AuditResult sheet = audit_picture(there->truth, hits, surface, torn, camera);
  EXPECT_EQ(sheet.pixels_set_aside, 0);
  EXPECT_TRUE(sheet.set_aside.empty());
  EXPECT_GT(std::abs(sheet.pixels.vertical_m[middle]), 100.0f);
  surface.is_solid = true;
  const AuditResult solid = audit_picture(there->truth, hits, surface, torn, camera);
  EXPECT_GT(solid.pixels_set_aside, 0);
  EXPECT_TRUE(std::isnan(solid.pixels.vertical_m[middle]));
}

}  // namespace
}  // namespace plumb::audit
