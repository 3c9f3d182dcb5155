#include "compare/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <tuple>

#include "compare/others_rules.h"
#include "core/check.h"
#include "support/run_command.h"

namespace plumb::compare {
namespace {

std::string message_of(const std::string& text) {
  try {
    parse_profile(text, "mine.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const Limit* limit_of(const Profile& profile, const std::string& group, const std::string& metric) {
  const auto found = std::find_if(
      profile.limits.begin(), profile.limits.end(),
      [&](const Limit& limit) { return limit.group == group && limit.metric == metric; });
  return found == profile.limits.end() ? nullptr : &*found;
}

TEST(Profile, IsReadFromAFile) {
  const Profile profile = parse_profile(R"(
meaning = "ours"
systematic = false
[options]
band_px = 2
[colour]
flip_mean = 0.05
psnr = 40
share_over = [{ above = 0.02, limit = 0.1 }, { above = 0.5, limit = 0 }]
[channel."N.X"]
largest = 0.25
)",
                                        "mine.toml");
  EXPECT_EQ(profile.name, "mine.toml");
  EXPECT_EQ(profile.meaning, "ours");
  EXPECT_FALSE(profile.judges_systematic);
  EXPECT_TRUE(profile.judges_numbers);
  EXPECT_EQ(profile.options.band_px, 2);
  const std::vector<Limit> expected{{"colour", "", "flip_mean", {}, 0.05},
                                    {"colour", "", "psnr", {}, 40.0},
                                    {"colour", "", "share_over", 0.02, 0.1},
                                    {"colour", "", "share_over", 0.5, 0.0},
                                    {"channel", "N.X", "largest", {}, 0.25}};
  EXPECT_EQ(profile.limits, expected);
}

TEST(Profile, InheritsAndReplacesAndDrops) {
  const Profile profile = parse_profile(R"(
inherits = "default"
[coverage]
holes = 3
overshoot = "none"
)",
                                        "mine.toml");
  ASSERT_NE(limit_of(profile, "coverage", "holes"), nullptr);
  EXPECT_EQ(limit_of(profile, "coverage", "holes")->bound, 3.0);
  EXPECT_EQ(limit_of(profile, "coverage", "overshoot"), nullptr);
  EXPECT_NE(limit_of(profile, "colour", "isolated_pixels"), nullptr);
  EXPECT_EQ(profile.limits.size(), find_profile("default").limits.size() - 1);
}

TEST(Profile, InheritsFromAFileBesideIt) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("base.toml")) << "[colour]\nmean = 0.125\n";
  std::ofstream(folder.file("mine.toml")) << "inherits = \"base.toml\"\n[colour]\nrmse = 0.5\n";
  const Profile profile = find_profile(folder.file("mine.toml"));
  ASSERT_NE(limit_of(profile, "colour", "mean"), nullptr);
  EXPECT_EQ(limit_of(profile, "colour", "mean")->bound, 0.125);
  std::ofstream(folder.file("base.toml")) << "inherits = \"mine.toml\"\n";
  EXPECT_THROW(find_profile(folder.file("mine.toml")), InputError);
}

TEST(Profile, ReadsBackAsItWasWritten) {
  for (const Profile& built_in : built_in_profiles()) {
    Profile read = parse_profile(to_toml(built_in), built_in.name);
    const auto order = [](const Limit& a, const Limit& b) {
      return std::tie(a.group, a.channel, a.metric, a.threshold) <
             std::tie(b.group, b.channel, b.metric, b.threshold);
    };
    Profile expected = built_in;
    std::sort(expected.limits.begin(), expected.limits.end(), order);
    std::sort(read.limits.begin(), read.limits.end(), order);
    EXPECT_EQ(read, expected) << to_toml(built_in);
  }
}

TEST(Profile, KnowsEveryRuleOfOthersByName) {
  for (const OtherRule& rule : other_rules()) {
    const Profile profile = find_profile(rule.name);
    ASSERT_EQ(profile.limits.size(), 1u);
    EXPECT_EQ(profile.limits.front().bound, rule.limit);
    EXPECT_FALSE(profile.judges_systematic);
  }
}

TEST(Profile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message_of("[color]\nmean = 1\n"),
            "mine.toml, line 1: color: unknown key; a profile has inherits, meaning, systematic, "
            "numbers, options, colour, alpha, depth, position, normal, id, lod, coverage, channel, "
            "others");
  EXPECT_EQ(message_of("[coverage]\nhole = 1\n"),
            "mine.toml, line 2: coverage.hole: unknown key; [coverage] has holes, overshoot");
  EXPECT_EQ(message_of("[colour]\nmean = -1\n"),
            "mine.toml, line 2: colour.mean: expected a number >= 0, got -1");
  EXPECT_EQ(message_of("[colour]\nmean = \"any\"\n"),
            "mine.toml, line 2: colour.mean: expected a number, or \"none\" to drop an inherited "
            "limit");
  EXPECT_NE(message_of("[colour]\nshare_over = { above = 1 }\n").find("limit = PER CENT"),
            std::string::npos);
  EXPECT_NE(message_of("[options]\nband = 1\n").find("unknown key"), std::string::npos);
  EXPECT_NE(message_of("inherits = \"nothing\"\n").find("there is no profile 'nothing'"),
            std::string::npos);
  EXPECT_THROW(find_profile("nowhere.toml"), InputError);
}

}  // namespace
}  // namespace plumb::compare
