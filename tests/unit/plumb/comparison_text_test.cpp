#include "comparison_text.h"

#include <gtest/gtest.h>

#include <sstream>

#include "text_table.h"
#include "unit/compare/small_comparisons.h"

namespace plumb::tool {
namespace {

using compare::testing::cracked_comparison;
using compare::testing::cracked_pair;
using compare::testing::equal_comparison;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ComparisonText, SaysTheVerdictFirstAndThenWhy) {
  const std::string text = comparison_text(cracked_comparison(cracked_pair()));
  EXPECT_EQ(text.rfind("FAILS: out/hill.exr is not what ref/hill.exr is", 0), 0u) << text;
  EXPECT_TRUE(has(text, "\n- 6 pixels show sky where terrain must be, the first at (20, 8)\n"));
  EXPECT_LT(text.find("- 6 pixels"), text.find("limit of 'default'"));
}

TEST(ComparisonText, MarksBrokenLimitsAndLeavesTheOthersToTheirPlace) {
  const std::string text = comparison_text(cracked_comparison(cracked_pair()));
  EXPECT_TRUE(has(text, "\n! BROKEN   coverage.holes")) << text;
  EXPECT_TRUE(has(text, "\n  holds    colour.psnr")) << text;
  EXPECT_LT(text.find("colour.largest "), text.find("colour.psnr"));
  EXPECT_LT(text.find("also measured"), text.find("share_over(0.02)"));
  EXPECT_TRUE(has(text, "not judged, no such channel: normal.largest_deg"));
  EXPECT_TRUE(has(text, "coverage: 6 holes and 0 overshooting pixels"));
  EXPECT_TRUE(has(text, "(20, 8)  hole"));
}

TEST(ComparisonText, NamesSystematicDifferencesBeforeAnyMetric) {
  compare::Comparison c = cracked_comparison(cracked_pair());
  c.systematic = {{compare::Systematic::Gain, "twice as bright", 0.5, 0.01}};
  const std::string text = comparison_text(c);
  EXPECT_LT(text.find("systematic: twice as bright (RMS 0.5 with it, 0.01 without)"),
            text.find("colour."));
}

TEST(ComparisonText, StaysWithinAHundredColumnsWhereNamesAreShort) {
  compare::Comparison c = cracked_comparison(cracked_pair());
  c.reasons.push_back("a reason that goes on and on " + std::string(60, 'x') +
                      " for much longer than a line has room, and then some");
  c.mask = compare::MaskReport{1, 1, 1};
  c.numbers = {3, 1, "channel N.X at (1000, 2000): nan, reference 0.123456"};
  std::istringstream lines(comparison_text(c));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(letters_in(line), 100) << line;
}

TEST(ComparisonText, HasALineForEachChannelByItself) {
  const std::string text = comparison_text(cracked_comparison(cracked_pair()));
  EXPECT_TRUE(has(text,
                  "\nchannel  largest      psnr\n"
                  "N.X            0         -\n"
                  "B              -  infinite\n"))
      << text;
}

TEST(ComparisonText, OfEqualPicturesHasNoListOfWorstPixels) {
  const std::string text = comparison_text(equal_comparison("a.png"));
  EXPECT_EQ(text.rfind("EQUAL: ", 0), 0u);
  EXPECT_FALSE(has(text, "reference  candidate"));
  EXPECT_TRUE(has(text, "infinite"));
}

TEST(FolderText, NamesWhatIsMissingBeforeThePairs) {
  compare::FolderComparison folders{
      "ref", "out", "default", {}, {{"lost.png", true}}, {{"bad.png", "unreadable"}}};
  folders.pairs.push_back({"a.png", equal_comparison("a.png")});
  folders.pairs.push_back({"hill.exr", cracked_comparison(cracked_pair())});
  const std::string text = folder_text(folders);
  EXPECT_EQ(text.rfind("NO VERDICT: out against ref", 0), 0u) << text;
  EXPECT_TRUE(
      has(text, "\nMISSING lost.png: missing in the candidate\nERROR bad.png: unreadable\n"));
  EXPECT_LT(text.find("bad.png"), text.find("FAILS"));
  EXPECT_LT(text.find("hill.exr"), text.find("a.png"));
  EXPECT_TRUE(has(text, "coverage.holes at most 0 px"));
}

TEST(Wrapped, BreaksBetweenWords) {
  EXPECT_EQ(wrapped("one two three", 7, 2), "one two\n  three\n");
  EXPECT_EQ(wrapped("one two three", 80, 2), "one two three\n");
  EXPECT_EQ(wrapped("a  longestword b", 6, 0), "a\nlongestword\nb\n");
  EXPECT_EQ(wrapped("", 6, 0), "");
  EXPECT_EQ(wrapped("\xc3\xb6\xc3\xb6 \xc3\xb6\xc3\xb6", 5, 0),
            "\xc3\xb6\xc3\xb6 \xc3\xb6\xc3\xb6\n");
  EXPECT_THROW(wrapped("a", 2, 2), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::tool
