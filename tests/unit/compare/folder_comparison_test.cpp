#include "compare/folder_comparison.h"

#include <gtest/gtest.h>

#include "compare/comparison_junit.h"
#include "compare/comparison_words.h"
#include "small_comparisons.h"
#include "support/small_xml.h"

namespace plumb::compare {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

FolderComparison mixed() {
  FolderComparison folders{"ref", "out", "default", {}, {}, {}};
  folders.pairs.push_back({"equal.png", testing::equal_comparison("equal.png")});
  folders.pairs.push_back({"near.png", testing::passing_comparison("near.png", 0.9)});
  folders.pairs.push_back({"z-far.png", testing::passing_comparison("z-far.png", 0.2)});
  folders.pairs.push_back({"a-far.png", testing::passing_comparison("a-far.png", 0.2)});
  folders.pairs.push_back({"slight.png", testing::passing_comparison("slight.png", 1.1)});
  folders.pairs.back().comparison.judgements[0].holds = false;
  folders.pairs.back().comparison.verdict = CompareVerdict::Fails;
  folders.pairs.push_back({"crack.exr", testing::cracked_comparison(testing::cracked_pair())});
  return folders;
}

TEST(FolderComparison, IsSortedByBadness) {
  const FolderComparison folders = mixed();
  std::vector<std::string> names;
  for (const std::size_t at : by_badness(folders)) names.push_back(folders.pairs[at].name);
  EXPECT_EQ(names, (std::vector<std::string>{"crack.exr", "slight.png", "near.png", "a-far.png",
                                             "z-far.png", "equal.png"}));
}

TEST(FolderComparison, FailsIfAPairDoesOrAFileIsMissing) {
  FolderComparison folders = mixed();
  EXPECT_EQ(folders.verdict(), CompareVerdict::Fails);
  folders.pairs.resize(4);
  EXPECT_EQ(folders.verdict(), CompareVerdict::Passes);
  folders.missing = {{"lost.png", true}};
  EXPECT_EQ(folders.verdict(), CompareVerdict::Fails);
  folders.missing.clear();
  folders.pairs.resize(1);
  EXPECT_EQ(folders.verdict(), CompareVerdict::Equal);
}

TEST(FolderComparison, HasNoVerdictIfAPairCouldNotBeComparedOrNothingIsThere) {
  FolderComparison folders = mixed();
  folders.errors = {{"bad.png", "unreadable"}};
  EXPECT_EQ(folders.verdict(), CompareVerdict::None);
  EXPECT_EQ(FolderComparison{}.verdict(), CompareVerdict::None);
  folders = mixed();
  folders.pairs[0].comparison.verdict = CompareVerdict::None;
  EXPECT_EQ(folders.verdict(), CompareVerdict::None);
}

TEST(FolderComparison, SaysHowManyOfEachKindThereAre) {
  FolderComparison folders = mixed();
  folders.missing = {{"lost.png", true}};
  EXPECT_EQ(verdict_sentence(folders),
            "out against ref, profile 'default', 7 files: 1 missing on one side, 2 failing, 3 "
            "passing, 1 equal.");
  EXPECT_EQ(verdict_sentence(FolderComparison{"ref", "out", "p", {}, {}, {}}),
            "There is no picture in ref and out.");
}

TEST(FolderJUnit, HasACaseForEachFileByName) {
  FolderComparison folders = mixed();
  folders.missing = {{"lost.png", true}};
  folders.errors = {{"bad.png", "bad.png: no picture & no <text>"}};
  const std::string xml = folder_junit(folders);
  EXPECT_EQ(plumb::testing::xml_fault(xml), "");
  EXPECT_TRUE(has(xml, "tests=\"8\" failures=\"3\" errors=\"1\" skipped=\"0\""));
  EXPECT_TRUE(has(
      xml, "name=\"lost.png\" time=\"0\">\n    <failure message=\"missing in the candidate\">"));
  EXPECT_TRUE(has(xml, "<error message=\"bad.png: no picture &amp; no &lt;text&gt;\"/>"));
  EXPECT_LT(xml.find("a-far.png"), xml.find("bad.png"));
  EXPECT_LT(xml.find("bad.png"), xml.find("crack.exr"));
}

TEST(ComparisonJUnit, FailsWithItsFirstReasonAndSaysTheRest) {
  const std::string xml = comparison_junit(testing::cracked_comparison(testing::cracked_pair()));
  EXPECT_EQ(plumb::testing::xml_fault(xml), "");
  EXPECT_TRUE(has(
      xml, "<failure message=\"6 pixels show sky where terrain must be, the first at (20, 8)\">"));
  EXPECT_TRUE(has(xml, "the largest difference is 0.43 where at most 0.1 is allowed\n"));
  EXPECT_TRUE(has(xml, "pixel (20, 8): hole 1, reference Z 2050, candidate Z inf\n"));
  EXPECT_TRUE(
      has(comparison_junit(testing::equal_comparison("a.png")), "failures=\"0\" errors=\"0\""));
  Comparison none = testing::equal_comparison("a.png");
  none.verdict = CompareVerdict::None;
  EXPECT_TRUE(has(comparison_junit(none), "<error message=\"The profile "));
}

}  // namespace
}  // namespace plumb::compare
