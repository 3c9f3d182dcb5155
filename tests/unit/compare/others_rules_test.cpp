#include "compare/others_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "grey_pictures.h"
#include "image/image_files.h"
#include "support/random_scene.h"
#include "support/run_command.h"

namespace plumb::compare {
namespace {

using image::Rgb8Image;

// The first `pixels` pixels darker by `by` in one channel.
Rgb8Image with_darker(Rgb8Image picture, int pixels, int by) {
  for (int k = 0; k < pixels; ++k)
    picture.rgb[static_cast<std::size_t>(3 * k + k % 3)] -= static_cast<std::uint8_t>(by);
  return picture;
}

Rgb8Image noise(std::uint64_t seed, int width, int height, int low = 0, int high = 255) {
  test_support::Random random(seed);
  Rgb8Image picture = even(0, width, height);
  for (std::uint8_t& value : picture.rgb)
    value = static_cast<std::uint8_t>(random.integer(low, high));
  return picture;
}

OtherVerdict judged(const char* name, const Rgb8Image& reference, const Rgb8Image& candidate) {
  const OtherRule* rule = find_other_rule(name);
  if (rule == nullptr) throw std::invalid_argument(name);
  return judge_by(*rule, reference, candidate);
}

TEST(OtherRules, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const OtherRule& rule : other_rules()) {
    EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
    EXPECT_EQ(find_other_rule(rule.name), &rule);
  }
  EXPECT_EQ(names.size(), 11u);
  EXPECT_EQ(find_other_rule("dssim"), nullptr);
}

TEST(OtherRules, PassEqualPictures) {
  for (const Rgb8Image& picture : {even(100), noise(1, 40, 33), noise(2, 7, 7)}) {
    for (const OtherRule& rule : other_rules())
      EXPECT_TRUE(judge_by(rule, picture, picture).passes) << rule.name;
  }
  EXPECT_EQ(judged("anari-ssim", noise(1, 40, 33), noise(1, 40, 33)).value, 1.0);
  EXPECT_EQ(judged("anari-psnr", even(3), even(3)).value, std::numeric_limits<double>::infinity());
}

TEST(OtherRules, JudgeAloneAsTogether) {
  const Rgb8Image a = noise(3, 50, 40, 90, 130), b = noise(4, 50, 40, 90, 130);
  const auto together = judge_by(other_rules(), a, b);
  for (std::size_t k = 0; k < other_rules().size(); ++k) {
    const OtherVerdict alone = judge_by(other_rules()[k], a, b);
    EXPECT_EQ(alone.value, together[k].value) << other_rules()[k].name;
    EXPECT_EQ(alone.passes, together[k].passes);
  }
}

TEST(OtherRules, HaveTheSameBitsOnAnyNumberOfThreads) {
  const Rgb8Image a = noise(3, 130, 90, 60, 200), b = noise(4, 130, 90, 60, 200);
  const auto one = [&] {
    const ThreadLimit limit(1);
    return judge_by(other_rules(), a, b);
  }();
  const ThreadLimit limit(7);
  const auto many = judge_by(other_rules(), a, b);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].value, many[k].value);
}

TEST(OtherRules, RefusePicturesThatCannotBeJudged) {
  EXPECT_THROW(judge_by(other_rules(), even(1, 16, 16), even(1, 16, 15)), std::invalid_argument);
  EXPECT_THROW(judge_by(other_rules(), even(1, 17, 16), even(1, 16, 16)), std::invalid_argument);
  EXPECT_THROW(judge_by(other_rules(), even(1, 6, 16), even(1, 6, 16)), std::invalid_argument);
  EXPECT_THROW(judge_by(other_rules(), even(1, 16, 6), even(1, 16, 6)), std::invalid_argument);
  Rgb8Image torn = even(1);
  torn.rgb.pop_back();
  EXPECT_THROW(judge_by(other_rules(), even(1), torn), std::invalid_argument);
  EXPECT_THROW(judge_by(other_rules(), torn, even(1)), std::invalid_argument);
}

// 196 pixels inside 16 x 16. All differ by d in three channels: 196 (3 (d - 4)^2)^2 / 251^4, which
// is 0.0171, 0.0225, 0.0467, 0.0579 for d = 18, 19, 22, 23.
TEST(OtherRules, FuzzySumsFourthPowers) {
  for (const int d : {18, 19, 22, 23}) {
    const double expected = 196.0 * 9.0 * std::pow(d - 4, 4) / std::pow(251, 4);
    const OtherVerdict loose = judged("conformance-fuzzy-0.05", even(100), even(100 + d));
    EXPECT_DOUBLE_EQ(loose.value, expected);
    EXPECT_EQ(loose.passes, d < 23);
    EXPECT_EQ(judged("conformance-fuzzy-0.02", even(100), even(100 + d)).passes, d < 19);
  }
}

// Evenly grey, so that only the lightness counts: FLIP's equations (6) to (8) are 0.95 dL^0.7 /
// (0.4 * 41.276), dL of two codes from 128 is 0.78, of three 1.17.
TEST(OtherRules, FlipMeanIsThatOfTheMap) {
  const auto lightness = [](int code) {
    return 116.0 * std::cbrt(std::pow((code / 255.0 + 0.055) / 1.055, 2.4)) - 16.0;
  };
  for (const int d : {2, 3}) {
    const OtherVerdict verdict = judged("flip-mean", even(128), even(128 + d));
    const double expected =
        0.95 * std::pow(lightness(128 + d) - lightness(128), 0.7) / (0.4 * 41.276);
    // Lightness in float: 2^-24 of 54 twice, over 0.78, times 0.7: 6e-6 of the value.
    EXPECT_NEAR(verdict.value, expected, 1e-5 * expected);
    EXPECT_EQ(verdict.passes, d == 2) << verdict.value;
  }
}

// 1000 pixels: one is 0.1 %, ten are 1 %.
TEST(OtherRules, SharesCountPixelsWithAnyChannelTooFar) {
  const Rgb8Image ground = even(100, 50, 20);
  for (const int pixels : {1, 2, 10, 11}) {
    const Rgb8Image candidate = with_darker(ground, pixels, 5);
    EXPECT_DOUBLE_EQ(judged("blender", ground, candidate).value, 0.1 * pixels);
    EXPECT_DOUBLE_EQ(judged("filament", ground, candidate).value, 0.1 * pixels);
    EXPECT_EQ(judged("blender", ground, candidate).passes, pixels <= 10);
    EXPECT_EQ(judged("filament", ground, candidate).passes, pixels <= 1);
  }
  EXPECT_EQ(judged("blender", ground, with_darker(ground, 1000, 4)).value, 0.0);
  EXPECT_EQ(judged("filament", ground, with_darker(ground, 1000, 4)).value, 0.0);
}

TEST(OtherRules, IdiffForgivesNothing) {
  const OtherVerdict verdict = judged("idiff", even(100), with_darker(even(100), 1, 1));
  EXPECT_EQ(verdict.value, 1.0);
  EXPECT_FALSE(verdict.passes);
}

// Even pictures have no variance: (2 a b + C1) / (a^2 + b^2 + C1), C1 = 2.55^2; 0.7022 and 0.6898.
TEST(OtherRules, SimilarityMustLieAboveItsLimit) {
  for (const int b : {41, 40}) {
    const OtherVerdict verdict = judged("anari-ssim", even(100), even(b));
    EXPECT_NEAR(verdict.value, (200.0 * b + 6.5025) / (10000.0 + b * b + 6.5025), 1e-14);
    EXPECT_EQ(verdict.passes, b == 41);
  }
}

// 20 dB is a mean square of 650.25: 192 values with squares that sum to 124848, which are 125 times
// 25^2, 40 times 26^2 and 27 times 27^2. At its limit the ratio does not pass.
TEST(OtherRules, SignalToNoiseMustLieAboveItsLimit) {
  const Rgb8Image a = even(0, 8, 8);
  Rgb8Image b = a;
  for (std::size_t k = 0; k < 192; ++k)
    b.rgb[k] = static_cast<std::uint8_t>(k < 125 ? 25 : k < 165 ? 26 : 27);
  EXPECT_EQ(judged("anari-psnr", a, b).value, 20.0);
  EXPECT_FALSE(judged("anari-psnr", a, b).passes);
  b.rgb[0] = 24;
  EXPECT_GT(judged("anari-psnr", a, b).value, 20.0);
  EXPECT_TRUE(judged("anari-psnr", a, b).passes);
}

// Ground with slopes of a code in eight pixels, and a crack in it as bright as the sky.
Rgb8Image cracked(int thickness_px, int length_px = 60) {
  return drawn(640, 360, [=](int x, int y) {
    const bool open = x >= 200 && x < 200 + length_px && y >= 150 && y < 150 + thickness_px;
    return open ? 220 : 60 + x / 8 + y / 8;
  });
}

TEST(OtherRules, MostPassACrackThatEverybodySees) {
  const Rgb8Image whole = cracked(0);
  for (const char* name :
       {"conformance-fuzzy-0.05", "conformance-fuzzy-0.02", "conformance-bilinear", "flip-mean",
        "blender", "filament", "anari-ssim", "anari-psnr"}) {
    EXPECT_TRUE(judged(name, whole, cracked(1)).passes) << name;
    EXPECT_TRUE(judged(name, whole, cracked(2)).passes) << name;
  }
  for (const char* name : {"pixelmatch", "pixelmatch-include-aa", "idiff"})
    EXPECT_FALSE(judged(name, whole, cracked(1)).passes) << name;
  EXPECT_EQ(judged("pixelmatch-include-aa", whole, cracked(1)).value, 60.0);
}

// From three pixels on its middle is like nothing nearby.
TEST(OtherRules, TheConformanceRulesSeeACrackOfThreePixels) {
  const Rgb8Image whole = cracked(0);
  EXPECT_FALSE(judged("conformance-fuzzy-0.05", whole, cracked(3)).passes);
  EXPECT_EQ(judged("conformance-bilinear", whole, cracked(3)).value, 58.0);
  EXPECT_TRUE(judged("filament", whole, cracked(3)).passes);
  EXPECT_TRUE(judged("anari-ssim", whole, cracked(3)).passes);
}

// The numbers before " pixels (...) over", line by line.
std::vector<int> pixels_over(const std::string& answer) {
  std::vector<int> counts;
  const std::string words = " pixels (";
  for (auto at = answer.find(words); at != std::string::npos; at = answer.find(words, at + 1))
    counts.push_back(std::stoi(answer.substr(answer.rfind('\n', at) + 1)));
  return counts;
}

// idiff warns from a millionth on and fails as told: one run has both counts. 9600 pixels, of which
// 96 may fail.
TEST(OtherRules, CountWhatIdiffCounts) {
  if (testing::run_command({"sh", "-c", "command -v idiff"}).status != 0)
    GTEST_SKIP() << "idiff is not installed";
  const testing::TemporaryFolder folder;
  const std::string a = folder.file("a.png"), b = folder.file("b.png");
  const Rgb8Image reference = noise(5, 120, 80, 60, 200);
  image::write_png(a, reference);
  for (const int pixels : {96, 97}) {
    Rgb8Image candidate = with_darker(with_darker(reference, pixels, 1), 300, 4);
    image::write_png(b, candidate);
    const auto answer =
        testing::run_command({"idiff", "-v", "-fail", "0.016", "-failpercent", "1", a, b});
    const OtherVerdict all = judged("idiff", reference, candidate),
                       share = judged("blender", reference, candidate);
    EXPECT_EQ(pixels_over(answer.out), (std::vector<int>{300, pixels})) << answer.out;
    EXPECT_EQ(all.value, 300.0);
    EXPECT_EQ(std::lround(share.value * 96.0), pixels);
    EXPECT_EQ(share.passes, answer.status < 2);  // 1 is a warning
  }
}

}  // namespace
}  // namespace plumb::compare
