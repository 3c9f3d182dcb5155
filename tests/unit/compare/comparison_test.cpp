// What is measured of two pictures, against numbers that can be worked out by head.
#include "compare/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/display_encoding.h"
#include "compare/value_models.h"
#include "core/check.h"
#include "core/parallel.h"
#include "image/camera_metadata.h"

namespace plumb::compare {
namespace {

using image::Encoding;
using image::PlaneImage;

constexpr int kWidth = 20, kHeight = 10;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

PlaneImage flat(std::vector<std::pair<std::string, float>> channels, int bits = 0) {
  PlaneImage picture;
  picture.width_px = kWidth;
  picture.height_px = kHeight;
  picture.bits = bits;
  picture.encoding = bits > 0 ? Encoding::Srgb : Encoding::Linear;
  for (const auto& [name, value] : channels)
    picture.planes.push_back({name, std::vector<float>(picture.size(), value)});
  return picture;
}

float& at(PlaneImage& picture, const std::string& channel, int x, int y) {
  for (image::Plane& plane : picture.planes) {
    if (plane.name == channel) return plane.values[static_cast<std::size_t>(y * kWidth + x)];
  }
  throw std::logic_error("no such channel");
}

PicturePair twice(const PlaneImage& picture) { return {"ref", "out", picture, picture, {}}; }

// No limits, nothing judged: numbers alone.
Profile measuring() {
  Profile profile{"measuring", "", {}, {}};
  profile.judges_systematic = false;
  return profile;
}

std::optional<double> measured(const Comparison& comparison, const std::string& name) {
  for (const Measurement& each : comparison.measurements) {
    if (each.name() == name) return each.value;
  }
  ADD_FAILURE() << "nothing measured as " << name;
  return std::nullopt;
}

const Profile& default_profile() { return built_in_profiles().front(); }

TEST(Comparison, OfEqualPicturesIsEqual) {
  const PlaneImage picture = flat({{"R", 0.25f}, {"G", 0.5f}, {"B", 0.75f}, {"Z", 100.0f}});
  const Comparison comparison = compare_pictures(twice(picture), default_profile());
  EXPECT_EQ(comparison.verdict, CompareVerdict::Equal);
  EXPECT_TRUE(comparison.reasons.empty());
  EXPECT_EQ(measured(comparison, "colour.psnr"), std::nullopt);  // infinite
  EXPECT_EQ(measured(comparison, "colour.ssim"), 1.0);
  EXPECT_EQ(measured(comparison, "colour.flip_largest"), 0.0);
  EXPECT_EQ(measured(comparison, "coverage.holes"), 0.0);
}

// One of 600 colour numbers differs by a half.
TEST(Comparison, MeasuresColourAsStored) {
  PicturePair pair = twice(flat({{"R", 0.25f}, {"G", 0.25f}, {"B", 0.25f}}, 8));
  at(pair.candidate, "G", 7, 3) = 0.75f;
  const Comparison comparison = compare_pictures(pair, measuring());
  EXPECT_EQ(measured(comparison, "colour.largest"), 0.5);
  EXPECT_DOUBLE_EQ(*measured(comparison, "colour.mean"), 0.5 / 600.0);
  EXPECT_DOUBLE_EQ(*measured(comparison, "colour.rmse"), std::sqrt(0.25 / 600.0));
  // Three quantities that are the same number, rounded once or twice on the way.
  EXPECT_NEAR(*measured(comparison, "colour.psnr"), 10.0 * std::log10(600.0 / 0.25), 1e-9);
  EXPECT_EQ(measured(comparison, "colour.share_over(0)"), 0.5);  // per cent: 1 of 200
  EXPECT_EQ(measured(comparison, "channel.G.largest"), 0.5);
  EXPECT_EQ(measured(comparison, "channel.R.largest"), 0.0);
}

TEST(Comparison, CountsThresholdsThatLimitsName) {
  PicturePair pair = twice(flat({{"R", 0.0f}, {"G", 0.0f}, {"B", 0.0f}}, 8));
  for (int x = 0; x < 4; ++x) at(pair.candidate, "R", x, 0) = 0.125f * static_cast<float>(x + 1);
  Profile profile = measuring();
  profile.limits.push_back({"colour", "", "share_over", 0.25, 1.0});
  const Comparison comparison = compare_pictures(pair, profile);
  EXPECT_EQ(measured(comparison, "colour.share_over(0.25)"), 1.0);  // 0.375 and 0.5, of 200
  EXPECT_EQ(comparison.verdict, CompareVerdict::Passes);
  profile.limits.front().bound = 0.9;
  EXPECT_EQ(compare_pictures(pair, profile).verdict, CompareVerdict::Fails);
}

// White among black that no 3 x 3 around explains: it stands out by all of its brightness.
TEST(Comparison, FindsAPixelThatStandsAlone) {
  PicturePair pair = twice(flat({{"R", 0.0f}, {"G", 0.0f}, {"B", 0.0f}}, 8));
  at(pair.candidate, "R", 5, 5) = 1.0f;
  const Comparison comparison = compare_pictures(pair, default_profile());
  EXPECT_EQ(measured(comparison, "colour.isolated_largest"), 1.0);
  EXPECT_EQ(comparison.verdict, CompareVerdict::Fails);
  ASSERT_FALSE(comparison.worst.empty());
  EXPECT_EQ(comparison.worst.front().x, 5);
  EXPECT_EQ(comparison.worst.front().y, 5);
  EXPECT_EQ(comparison.worst.front().candidate, "255 0 0");
}

TEST(Comparison, MeasuresDepthRelativeToTheReference) {
  PicturePair pair = twice(flat({{"Z", 200.0f}}));
  at(pair.candidate, "Z", 3, 4) = 250.0f;
  const Comparison comparison = compare_pictures(pair, measuring());
  EXPECT_EQ(measured(comparison, "depth.relative_largest"), 0.25);
  EXPECT_NEAR(*measured(comparison, "depth.relative_mean"), 0.25 / 200.0, 1e-12);
  EXPECT_EQ(measured(comparison, "depth.relative_p99"), 0.0);
}

TEST(Comparison, SkyBesideGroundIsCoverageAndNoNumber) {
  PicturePair pair = twice(flat({{"Z", 200.0f}}));
  at(pair.candidate, "Z", 3, 4) = kInfinity;
  const Comparison comparison = compare_pictures(pair, default_profile());
  EXPECT_EQ(measured(comparison, "coverage.holes"), 1.0);
  EXPECT_EQ(comparison.numbers.unlike, 0);
  EXPECT_EQ(comparison.verdict, CompareVerdict::Fails);
}

// Points 3 and 4 m apart across and upwards, 100 m away, 50 pixels a unit: 5 m are 2.5 px.
TEST(Comparison, MeasuresPositionsInPixelsAtTheirDepth) {
  PlaneImage picture = flat({{"Z", 100.0f}, {"P.X", 0.0f}, {"P.Y", 100.0f}, {"P.Z", 0.0f}});
  Camera camera;
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  camera.gamma_h = camera.gamma_v = 50.0;
  image::add_camera(camera, picture.metadata);
  PicturePair pair = twice(picture);
  at(pair.candidate, "P.X", 2, 2) = 3.0f;
  at(pair.candidate, "P.Z", 2, 2) = 4.0f;
  EXPECT_EQ(measured(compare_pictures(pair, measuring()), "position.largest_px"), 2.5);
}

TEST(Comparison, MeasuresNormalsInDegrees) {
  PicturePair pair = twice(flat({{"N.X", 0.0f}, {"N.Y", 0.0f}, {"N.Z", 1.0f}}));
  at(pair.candidate, "N.X", 2, 2) = 1.0f;
  at(pair.candidate, "N.Z", 2, 2) = 0.0f;
  const Comparison comparison = compare_pictures(pair, measuring());
  EXPECT_NEAR(*measured(comparison, "normal.largest_deg"), 90.0, 1e-5);  // a float's rounding
  EXPECT_EQ(measured(comparison, "normal.unmatched_share"), 0.0);  // the reference's is beside it
}

TEST(Comparison, CountsNamesThatAreConfused) {
  PicturePair pair = twice(flat({{"id", 3.0f}}));
  for (int x = 0; x < 5; ++x) at(pair.candidate, "id", x, 0) = x < 4 ? 7.0f : 8.0f;
  const Comparison comparison = compare_pictures(pair, measuring());
  EXPECT_EQ(measured(comparison, "id.differing_share"), 2.5);
  EXPECT_EQ(measured(comparison, "id.confused_pairs"), 2.0);
  ASSERT_EQ(comparison.notes.size(), 3u);
  EXPECT_EQ(comparison.notes.front(), "id 3 of the reference is 7 in 4 pixels");
  EXPECT_EQ(comparison.notes.back(), "no limit of the profile speaks of: id");
}

// What is masked must not hide that all the rest is a constant brighter.
TEST(Comparison, NamesWhatIsSystematicBesideAMask) {
  PicturePair pair = twice(flat({{"R", 0.5f}, {"G", 0.4f}, {"B", 0.3f}}));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (const char* channel : {"R", "G", "B"}) {
        at(pair.reference, channel, x, y) += 0.013f * static_cast<float>((3 * x + 7 * y) % 11);
        at(pair.candidate, channel, x, y) = at(pair.reference, channel, x, y) + 0.01f;
      }
    }
  }
  pair.mask.assign(pair.size(), 1);
  std::fill_n(pair.mask.begin(), 3 * pair.size() / 4, std::uint8_t{0});
  const Comparison comparison = compare_pictures(pair, default_profile());
  ASSERT_EQ(comparison.systematic.size(), 1u);
  EXPECT_EQ(comparison.systematic.front().kind, Systematic::Offset);
  EXPECT_EQ(comparison.verdict, CompareVerdict::Fails);
  pair.mask.assign(pair.size(), 0);
  EXPECT_THROW(compare_pictures(pair, default_profile()), InputError);
}

// Nothing that is a number is nothing that is equal.
TEST(Comparison, HoldsNoLimitByNumbersThatAreNone) {
  PicturePair pair = twice(flat({{"R", 0.5f}, {"G", 0.4f}, {"B", 0.3f}}));
  for (image::Plane& plane : pair.candidate.planes)
    std::fill(plane.values.begin(), plane.values.end(), kNan);
  Profile profile = measuring();
  profile.judges_numbers = false;
  profile.limits = {{"colour", "", "psnr", {}, 40.0}, {"colour", "", "largest", {}, 0.1}};
  const Comparison comparison = compare_pictures(pair, profile);
  EXPECT_EQ(comparison.verdict, CompareVerdict::None);
  EXPECT_EQ(comparison.not_judged.size(), 2u);
}

TEST(Comparison, CountsNumbersThatAreNone) {
  PicturePair pair = twice(flat({{"R", 0.5f}, {"G", 0.5f}, {"B", 0.5f}}));
  at(pair.reference, "R", 1, 1) = at(pair.candidate, "R", 1, 1) = kNan;
  EXPECT_EQ(compare_pictures(pair, default_profile()).verdict, CompareVerdict::Equal);
  at(pair.candidate, "G", 4, 2) = kInfinity;
  const Comparison comparison = compare_pictures(pair, default_profile());
  EXPECT_EQ(comparison.numbers.alike, 1);
  EXPECT_EQ(comparison.numbers.unlike, 1);
  EXPECT_EQ(comparison.numbers.first, "channel G at (4, 2): inf, the reference has 0.5");
  EXPECT_EQ(comparison.verdict, CompareVerdict::Fails);
  EXPECT_EQ(measured(comparison, "colour.mean"), 0.0);  // never averaged
}

TEST(Comparison, AMaskHidesAndSaysSo) {
  PicturePair pair = twice(flat({{"R", 0.0f}, {"G", 0.0f}, {"B", 0.0f}}, 8));
  at(pair.candidate, "R", 5, 5) = 1.0f;
  at(pair.candidate, "R", 15, 5) = 1.0f / 255.0f;
  pair.mask.assign(pair.size(), 1);
  for (const int x : {5, 15, 16}) pair.mask[static_cast<std::size_t>(5 * kWidth + x)] = 0;
  const Comparison comparison = compare_pictures(pair, default_profile());
  EXPECT_EQ(comparison.verdict, CompareVerdict::Equal);
  ASSERT_TRUE(comparison.mask.has_value());
  EXPECT_EQ(comparison.mask->masked, 3);
  EXPECT_EQ(comparison.mask->would_differ, 2);
  EXPECT_EQ(comparison.mask->would_fail, 1);
  EXPECT_EQ(measured(comparison, "colour.flip_largest"), 0.0);
}

TEST(Comparison, NamesASystematicDifferenceAsTheFirstReason) {
  PicturePair pair = twice(flat({{"Y", 0.0f}}));
  for (int k = 0; k < kWidth * kHeight; ++k) {
    pair.reference.planes[0].values[static_cast<std::size_t>(k)] = 0.004f * static_cast<float>(k);
    pair.candidate.planes[0].values[static_cast<std::size_t>(k)] = 0.002f * static_cast<float>(k);
  }
  const Comparison comparison = compare_pictures(pair, default_profile());
  ASSERT_FALSE(comparison.reasons.empty());
  EXPECT_EQ(comparison.reasons.front(), "the candidate is the reference times 0.5");
  EXPECT_EQ(comparison.verdict, CompareVerdict::Fails);
}

TEST(Comparison, HasNoVerdictWhereNothingCanBeJudged) {
  PicturePair pair = twice(flat({{"heat", 1.0f}}));
  at(pair.candidate, "heat", 0, 0) = 2.0f;
  const Comparison comparison = compare_pictures(pair, default_profile());
  EXPECT_EQ(comparison.verdict, CompareVerdict::None);
  EXPECT_EQ(comparison.not_judged.size(), default_profile().limits.size());
}

TEST(Comparison, ExactAllowsNoNumberToDiffer) {
  PicturePair pair = twice(flat({{"heat", 1.0f}, {"Z", 5.0f}}));
  const Profile exact = find_profile("exact");
  EXPECT_EQ(compare_pictures(pair, exact).verdict, CompareVerdict::Equal);
  at(pair.candidate, "heat", 0, 0) = std::nextafter(1.0f, 2.0f);
  EXPECT_EQ(compare_pictures(pair, exact).verdict, CompareVerdict::Fails);
}

TEST(Comparison, TellsOtherCamerasAndTerrainsOfTheHeaders) {
  PicturePair pair = twice(flat({{"Z", 5.0f}}));
  Camera camera;
  image::add_camera(camera, pair.reference.metadata);
  camera.eye_m.z = 10.0;
  image::add_camera(camera, pair.candidate.metadata);
  pair.reference.metadata["terrain.checksum"] = std::string("0123");
  pair.candidate.metadata["terrain.checksum"] = std::string("4567");
  const Comparison comparison = compare_pictures(pair, default_profile());
  ASSERT_EQ(comparison.notes.size(), 2u);
  EXPECT_NE(comparison.notes[0].find("(0, 0, 10) m"), std::string::npos);
  EXPECT_NE(comparison.notes[1].find("different terrains"), std::string::npos);
}

TEST(Comparison, RefusesWhatCannotBeCompared) {
  const auto message = [](const PicturePair& pair) -> std::string {
    try {
      compare_pictures(pair, default_profile());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  PicturePair pair = twice(flat({{"Z", 5.0f}}));
  pair.candidate.width_px = 10;
  pair.candidate.height_px = 20;
  EXPECT_EQ(message(pair),
            "pictures of different size: 'ref' has 20 x 10 pixels, 'out' has 10 x 20");
  pair = {"ref", "out", flat({{"Z", 5.0f}}), flat({{"Y", 5.0f}}), {}};
  EXPECT_EQ(message(pair), "pictures with different channels: 'ref' has Z, 'out' has Y");
  pair = {"ref", "out", flat({{"Y", 5.0f}}), flat({{"Y", 5.0f}}, 8), {}};
  EXPECT_EQ(message(pair), "pictures of unlike kinds: 'ref' is linear, 'out' is sRGB");
}

TEST(DisplayEncoding, IsTheCurveOfSrgb) {
  const DisplayEncoding encoded;
  for (int k = -4000; k < 4000; ++k) {
    const float linear = static_cast<float>(std::exp2(k / 400.0));
    const double exact = linear_to_srgb(double{linear});
    EXPECT_NEAR(double{encoded(linear)}, exact, 2e-7 * std::max(exact, 0.04)) << linear;
    EXPECT_LE(encoded(linear), encoded(std::nextafter(linear, 1e9f)));
  }
  EXPECT_EQ(encoded(0.0f), 0.0f);
  EXPECT_EQ(encoded(-1.0f), 0.0f);
  EXPECT_EQ(encoded(1.0f), 1.0f);
}

TEST(Comparison, HasTheSameBitsOnAnyNumberOfThreads) {
  PicturePair pair = twice(flat({{"R", 0.3f}, {"G", 0.4f}, {"B", 0.5f}, {"Z", 9.0f}}));
  for (std::size_t k = 0; k < pair.size(); ++k)
    pair.candidate.planes[k % 4].values[k] += 0.001f * static_cast<float>(k % 17);
  std::vector<Comparison> found;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    found.push_back(compare_pictures(pair, default_profile()));
  }
  ASSERT_EQ(found[0].measurements.size(), found[1].measurements.size());
  for (std::size_t k = 0; k < found[0].measurements.size(); ++k)
    EXPECT_EQ(found[0].measurements[k].value, found[1].measurements[k].value);
  EXPECT_EQ(found[0].reasons, found[1].reasons);
}

}  // namespace
}  // namespace plumb::compare
