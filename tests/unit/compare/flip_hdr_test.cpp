#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/flip.h"
#include "compare/flip_kernels.h"
#include "core/parallel.h"
#include "support/flip_pictures.h"

namespace plumb::compare {
namespace {

using testing::FlipPicture;

FlipPicture greys(const std::vector<double>& luminances) {
  return {static_cast<int>(luminances.size()), 1,
          [&](int x, int) { return glm::dvec3(luminances[static_cast<std::size_t>(x)]); }};
}

ExposureRange range_of(const std::vector<double>& luminances, HdrFlipOptions options = {}) {
  return flip_exposures(greys(luminances).planes(), options);
}

// Reinhard's x / (1 + x) is 0.85 at 17/3. The median of 1 1 5 is 1, the largest 5: from
// log2(17/15) to log2(17/3), which are 2.32 stops, so three exposures.
TEST(FlipExposures, ComeFromTheReferencesMedianAndLargestLuminance) {
  const ExposureRange range = range_of({1, 5, 1}, {.tone_mapper = ToneMapper::Reinhard});
  EXPECT_NEAR(range.start_stops, std::log2(17.0 / 15.0), 1e-12);
  EXPECT_NEAR(range.stop_stops, std::log2(17.0 / 3.0), 1e-12);
  EXPECT_EQ(range.count, 3);
  EXPECT_NEAR(range.stops(1), 0.5 * (range.start_stops + range.stop_stops), 1e-12);
  EXPECT_NEAR(range.stops(2), range.stop_stops, 1e-12);
}

TEST(FlipExposures, WeighTheChannelsByTheirLuminance) {
  const FlipPicture red(1, 1, {1, 0, 0}), green(1, 1, {0, 1, 0}), blue(1, 1, {0, 0, 1});
  const HdrFlipOptions reinhard{.tone_mapper = ToneMapper::Reinhard};
  EXPECT_NEAR(flip_exposures(red.planes(), reinhard).start_stops, std::log2(17.0 / 3.0 / 0.2126),
              1e-7);
  EXPECT_NEAR(flip_exposures(green.planes(), reinhard).start_stops, std::log2(17.0 / 3.0 / 0.7152),
              1e-7);
  EXPECT_NEAR(flip_exposures(blue.planes(), reinhard).start_stops, std::log2(17.0 / 3.0 / 0.0722),
              1e-7);
}

TEST(FlipExposures, TakeTheUpperOfTwoMedians) {
  const ExposureRange range = range_of({1, 2, 4, 8}, {.tone_mapper = ToneMapper::Reinhard});
  EXPECT_NEAR(range.stop_stops, std::log2(17.0 / 3.0 / 4.0), 1e-12);
}

// The largest luminance becomes 0.85 at the first exposure, the median at the last.
TEST(FlipExposures, MapToTheSameBrightnessWithEveryCurve) {
  const ExposureRange aces = range_of({0.5, 3, 40});
  EXPECT_NEAR(testing::slow_aces(std::exp2(aces.start_stops) * 40), 0.85, 1e-12);
  EXPECT_NEAR(testing::slow_aces(std::exp2(aces.stop_stops) * 3), 0.85, 1e-12);
  const ExposureRange hable = range_of({0.5, 3, 40}, {.tone_mapper = ToneMapper::Hable});
  // Its printed coefficients have four digits or more.
  EXPECT_NEAR(testing::slow_hable(std::exp2(hable.start_stops) * 40), 0.85, 1e-4);
  EXPECT_NEAR(testing::slow_hable(std::exp2(hable.stop_stops) * 3), 0.85, 1e-4);
}

TEST(FlipExposures, ShiftWithTheLight) {
  const ExposureRange once = range_of({0.1, 1, 20}), brighter = range_of({0.8, 8, 160});
  EXPECT_NEAR(brighter.start_stops, once.start_stops - 3.0, 1e-12);
  EXPECT_NEAR(brighter.stop_stops, once.stop_stops - 3.0, 1e-6);  // 0.8 is not 8 * 0.1 in float32
  EXPECT_EQ(brighter.count, once.count);
}

TEST(FlipExposures, LookAtWhatIsLitIfMostIsBlack) {
  const ExposureRange range = range_of({0, -2, 0, 0, 3, 9, 6}), lit = range_of({3, 9, 6});
  EXPECT_EQ(range.start_stops, lit.start_stops);
  EXPECT_EQ(range.stop_stops, lit.stop_stops);
  const ExposureRange black = range_of({0, 0, -1});
  EXPECT_EQ(black.start_stops, 0.0);
  EXPECT_EQ(black.stop_stops, 0.0);
  EXPECT_EQ(black.count, 2);
}

TEST(FlipExposures, MayBeGiven) {
  const ExposureRange all = range_of({1}, {.start_stops = -2.0, .stop_stops = 4.0, .exposures = 4});
  EXPECT_EQ(all.count, 4);
  EXPECT_EQ(all.stops(0), -2.0);
  EXPECT_EQ(all.stops(1), 0.0);
  EXPECT_EQ(all.stops(3), 4.0);
  EXPECT_EQ(range_of({1}, {.start_stops = -2.0, .stop_stops = 4.5}).count, 7);
  const ExposureRange half = range_of({0.5, 3, 40}, {.start_stops = -20.0});
  EXPECT_EQ(half.start_stops, -20.0);
  EXPECT_EQ(half.stop_stops, range_of({0.5, 3, 40}).stop_stops);
  EXPECT_EQ(range_of({1, 9}, {.exposures = 1}).stops(0), range_of({1, 9}).start_stops);
}

TEST(FlipExposures, StayWhereAFloatCanFollow) {
  const ExposureRange dark = range_of({1e-44, 1e-44}), bright = range_of({3e38, 3e38});
  EXPECT_EQ(dark.start_stops, 120.0);
  EXPECT_EQ(bright.start_stops, -120.0);
}

TEST(FlipExposures, NameWhatIsWrong) {
  EXPECT_THROW(range_of({1}, {.start_stops = 2.0, .stop_stops = 1.0}), std::invalid_argument);
  EXPECT_THROW(range_of({1}, {.start_stops = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(range_of({1}, {.stop_stops = 121.0}), std::invalid_argument);
  EXPECT_THROW(range_of({1}, {.exposures = 0}), std::invalid_argument);
  EXPECT_THROW(range_of({1}, {.exposures = 1001}), std::invalid_argument);
  EXPECT_THROW(range_of({std::nan("")}), std::invalid_argument);
}

TEST(FlipToneCurves, AreThoseOfTheirAuthors) {
  const ToneCurve aces{{0.9036f, 0.018f, 0.0f, 0.8748f, 0.354f, 0.14f}, false};
  const ToneCurve reinhard{{0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f}, true};
  std::vector<float> light{0.0f, -1.0f, 1e-30f, 1e-4f, 0.03f, 0.18f, 0.5f, 1.0f,
                           2.0f, 7.0f,  50.0f,  1e6f,  1e30f, 3e38f, 0.9f, 1e-3f};
  for (const InstructionSet set : available_instruction_sets()) {
    for (const float gain : {0.25f, 1.0f, 3e30f}) {
      std::vector<float> rows[3] = {light, light, light};
      float* rgb[] = {rows[0].data(), rows[1].data(), rows[2].data()};
      flip_kernels(set).expose(aces, gain, kFlipLanes, rgb);
      for (std::size_t k = 0; k < light.size(); ++k) {
        const double x = std::min(1e18, static_cast<double>(gain) * light[k]);
        EXPECT_NEAR(rows[0][k], testing::slow_aces(x), 5e-7) << x;
        EXPECT_EQ(rows[1][k], rows[0][k]);
      }
      std::vector<float> colour[3] = {light, std::vector<float>(16, 0.0f), light};
      float* channels[] = {colour[0].data(), colour[1].data(), colour[2].data()};
      flip_kernels(set).expose(reinhard, gain, kFlipLanes, channels);
      for (std::size_t k = 0; k < light.size(); ++k) {
        const double x = std::clamp(static_cast<double>(gain) * light[k], 0.0, 1e18);
        EXPECT_NEAR(colour[0][k], std::min(1.0, x / (1.0 + (0.2126 + 0.0722) * x)), 5e-7) << x;
        EXPECT_EQ(colour[1][k], 0.0f);
      }
    }
  }
}

// Light over ten stops.
FlipPicture lit_picture(int width, int height, std::uint64_t seed) {
  const FlipPicture even = testing::patchy_picture(width, height, seed);
  FlipPicture lit = even;
  for (auto& channel : lit.channel) {
    for (float& value : channel) value = 8.0f * value * value * value * value;
  }
  return lit;
}

void expect_as_slow(const FlipPicture& reference, const FlipPicture& candidate,
                    const HdrFlipOptions& options, double (*curve)(double), double tolerance) {
  const HdrFlip flip = flip_hdr(reference.planes(), candidate.planes(), options);
  std::vector<double> largest(reference.channel[0].size(), 0.0);
  std::vector<std::vector<double>> all;
  for (int k = 0; k < flip.range.count; ++k) {
    const double gain = std::exp2(flip.range.stops(k));
    const auto exposed = [&](const glm::dvec3& c) {
      return glm::dvec3(curve(gain * c.x), curve(gain * c.y), curve(gain * c.z));
    };
    all.push_back(testing::slow_flip(reference.slow().map(exposed), candidate.slow().map(exposed),
                                     options.pixels_per_degree));
    for (std::size_t p = 0; p < largest.size(); ++p) largest[p] = std::max(largest[p], all[k][p]);
  }
  for (std::size_t p = 0; p < largest.size(); ++p) {
    ASSERT_NEAR(flip.largest.error[p], largest[p], tolerance) << p;
    ASSERT_NEAR(all[static_cast<std::size_t>(flip.exposure_index[p])][p], largest[p],
                2.0 * tolerance);
  }
}

// Tolerances as in flip_test.cpp; Hable's printed coefficients differ from his own by 4e-5 of
// themselves, which colour differences carry on.
TEST(FlipHdr, AgreesWithTheSlowComputation) {
  const FlipPicture a = lit_picture(27, 18, 1), b = lit_picture(27, 18, 2);

  expect_as_slow(a, b, {}, testing::slow_aces, 8e-5);
  expect_as_slow(a, b, {.start_stops = -3.0, .stop_stops = 3.0, .exposures = 4}, testing::slow_aces,
                 8e-5);
  expect_as_slow(a, b, {.tone_mapper = ToneMapper::Hable, .exposures = 3}, testing::slow_hable,
                 3e-4);
}

TEST(FlipHdr, IsZeroForEqualPictures) {
  const FlipPicture picture = lit_picture(20, 9, 3);
  const HdrFlip flip = flip_hdr(picture.planes(), picture.planes());
  EXPECT_EQ(flip.largest.error, std::vector<float>(180, 0.0f));
  EXPECT_EQ(flip.exposure_index, std::vector<int>(180, 0));
}

// Left: light 100 against 50, which burns out when exposed for the dark. Right: 0.01 against 0.02,
// which only shows then.
TEST(FlipHdr, NamesTheExposureThatShowsTheDifference) {
  const FlipPicture reference(64, 8, [](int x, int) { return glm::dvec3(x < 32 ? 100.0 : 0.01); });
  const FlipPicture candidate(64, 8, [](int x, int) { return glm::dvec3(x < 32 ? 50.0 : 0.02); });
  const HdrFlip flip =
      flip_hdr(reference.planes(), candidate.planes(), {.start_stops = -7.0, .stop_stops = 7.0});
  EXPECT_EQ(flip.range.count, 14);
  EXPECT_LT(flip.exposure_index[4 * 64 + 5], 4);
  EXPECT_GT(flip.exposure_index[4 * 64 + 60], 9);
}

TEST(FlipHdr, HasTheSameBitsWithEveryInstructionSetAndOnAnyNumberOfThreads) {
  const FlipPicture a = lit_picture(35, 40, 4), b = lit_picture(35, 40, 5);
  HdrFlip first;
  for (const InstructionSet set : available_instruction_sets()) {
    const ForcedInstructionSet forced(set);
    for (const int threads : {1, 7}) {
      const ThreadLimit limit(threads);
      const HdrFlip flip = flip_hdr(a.planes(), b.planes());
      if (first.range.count == 0) first = flip;
      EXPECT_EQ(flip.largest.error, first.largest.error) << name_of(set) << ' ' << threads;
      EXPECT_EQ(flip.exposure_index, first.exposure_index) << name_of(set) << ' ' << threads;
    }
  }
}

TEST(FlipHdr, NamesWhatIsWrong) {
  const FlipPicture a = lit_picture(5, 4, 6), b = lit_picture(4, 5, 6);
  EXPECT_THROW(flip_hdr(a.planes(), b.planes()), std::invalid_argument);
  FlipPicture spoilt = a;
  spoilt.channel[2][3] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(flip_hdr(a.planes(), spoilt.planes()), std::invalid_argument);
  EXPECT_THROW(flip_hdr(spoilt.planes(), a.planes()), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::compare
