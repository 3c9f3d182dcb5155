#include "compare/comparison_words.h"

#include <gtest/gtest.h>

#include <limits>

#include "small_comparisons.h"

namespace plumb::compare {
namespace {

using testing::judged;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(ComparisonWords, NumbersKeepTheDigitsOfWholeOnes) {
  EXPECT_EQ(short_number(2073600.0), "2073600");
  EXPECT_EQ(short_number(0.00392156862), "0.003922");
  EXPECT_EQ(short_number(-0.0), "0");
  EXPECT_EQ(short_number(kInfinite, "px"), "inf px");
  EXPECT_EQ(short_number(12.5, "dB"), "12.5 dB");
}

TEST(ComparisonWords, AValueThatIsNoneIsInfinite) {
  EXPECT_EQ(value_text({"colour", "", "psnr", {}, {}}), "infinite");
  EXPECT_EQ(value_text({"colour", "", "psnr", {}, 40.0}), "40 dB");
}

TEST(ComparisonWords, BoundsSayInWhichDirection) {
  const Measurement psnr{"colour", "", "psnr", {}, 25.0}, holes{"coverage", "", "holes", {}, 2.0};
  EXPECT_EQ(bound_text({"colour", "", "psnr", {}, 30.0}, psnr.info()), "at least 30 dB");
  EXPECT_EQ(bound_text({"coverage", "", "holes", {}, 0.0}, holes.info()), "at most 0 px");
}

// 0.05 of 0.1 is half, and so is a bound of 20 dB where 40 were measured.
TEST(ComparisonWords, UseIsTheShareOfTheLimit) {
  EXPECT_EQ(use_of(judged({"colour", "", "largest", {}, 0.05}, 0.1, true)), 0.5);
  EXPECT_EQ(use_of(judged({"colour", "", "psnr", {}, 40.0}, 20.0, true)), 0.5);
  EXPECT_EQ(use_of(judged({"colour", "", "largest", {}, 0.3}, 0.1, false)), 0.3 / 0.1);
  EXPECT_EQ(use_of(judged({"colour", "", "psnr", {}, 10.0}, 20.0, false)), 2.0);
}

TEST(ComparisonWords, UseIsAboveOneWhereALimitIsBrokenAndNowhereElse) {
  EXPECT_EQ(use_of(judged({"coverage", "", "holes", {}, 3.0}, 0.0, false)), kInfinite);
  EXPECT_EQ(use_of(judged({"coverage", "", "holes", {}, 0.0}, 0.0, true)), 0.0);
  EXPECT_EQ(use_of(judged({"colour", "", "psnr", {}, {}}, 20.0, true)), 0.0);
  EXPECT_EQ(use_of(judged({"colour", "", "ssim", {}, -0.5}, 0.7, false)), kInfinite);
  EXPECT_EQ(use_of(judged({"colour", "", "largest", {}, kInfinite}, 1.0, false)), kInfinite);
  EXPECT_EQ(use_of(judged({"colour", "", "largest", {}, std::nan("")}, 1.0, false)), kInfinite);
}

TEST(ComparisonWords, UseIsSaidInPerCent) {
  EXPECT_EQ(use_text(judged({"colour", "", "largest", {}, 0.05}, 0.1, true)), "50 %");
  EXPECT_EQ(use_text(judged({"colour", "", "largest", {}, 3.06}, 0.1, false)), "3060 %");
  EXPECT_EQ(use_text(judged({"coverage", "", "holes", {}, 3.0}, 0.0, false)), "inf");
}

TEST(ComparisonWords, ChannelsStandInATableOfTheirOwn) {
  Comparison c;
  c.measurements = {{"colour", "", "largest", {}, 0.5},
                    {"channel", "R", "largest", {}, 0.5},
                    {"channel", "R", "psnr", {}, 40.0},
                    {"channel", "Z", "largest", {}, 7.0},
                    {"channel", "Z", "share_over", 0.5, 1.5}};
  const ChannelTable table = channel_table(c);
  EXPECT_EQ(table.channels, (std::vector<std::string>{"R", "Z"}));
  EXPECT_EQ(table.metrics, (std::vector<std::string>{"largest", "psnr", "share_over(0.5)"}));
  EXPECT_EQ(table.values,
            (std::vector<std::vector<std::string>>{{"0.5", "40 dB", "-"}, {"7", "-", "1.5 %"}}));
}

TEST(ComparisonWords, JudgementsComeBrokenOnesFirst) {
  const PicturePair pair = testing::cracked_pair();
  const Comparison c = testing::cracked_comparison(pair);
  const auto order = by_use(c);
  ASSERT_EQ(order.size(), 4u);
  EXPECT_EQ(order[0]->measured.metric, "holes");      // infinite
  EXPECT_EQ(order[1]->measured.metric, "largest");    // 4.3
  EXPECT_EQ(order[2]->measured.metric, "psnr");       // 30 / 38.25
  EXPECT_EQ(order[3]->measured.metric, "flip_mean");  // 0.246
  EXPECT_EQ(tightest(c), order[0]);
  EXPECT_EQ(tightest(Comparison{}), nullptr);
}

TEST(ComparisonWords, TheSentenceSaysWhy) {
  Comparison c = testing::cracked_comparison(testing::cracked_pair());
  EXPECT_EQ(verdict_sentence(c),
            "out/hill.exr is not what ref/hill.exr is, by the profile 'default': 2 of 4 limits "
            "broken.");
  c.systematic = {{Systematic::Offset, "an offset", 1.0, 0.1}};
  c.numbers = {0, 3, "channel R at (0, 0): nan, reference 0.5"};
  EXPECT_EQ(verdict_sentence(c),
            "out/hill.exr is not what ref/hill.exr is, by the profile 'default': 2 of 4 limits "
            "broken, 1 systematic difference, 3 NaN or infinite in one picture alone.");
}

TEST(ComparisonWords, TheSentenceOfEqualPicturesSaysWhatTheMaskLeavesOpen) {
  Comparison c = testing::equal_comparison("a.png");
  EXPECT_EQ(verdict_sentence(c),
            "out/a.png and ref/a.png are the same in every number of 3 channels.");
  c.mask = MaskReport{5, 5, 1};
  EXPECT_EQ(verdict_sentence(c),
            "out/a.png and ref/a.png are the same in every number of 3 channels wherever the mask "
            "judges.");
}

TEST(ComparisonWords, TheSentenceWithoutAVerdictNamesProfileAndChannels) {
  Comparison c = testing::equal_comparison("a.png");
  c.verdict = CompareVerdict::None;
  EXPECT_EQ(verdict_sentence(c), "The profile 'default' has no limit that can be judged on R G B.");
}

}  // namespace
}  // namespace plumb::compare
