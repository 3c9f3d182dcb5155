#include "compare/comparison_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "compare/comparison_json.h"
#include "compare/comparison_tables.h"
#include "core/check.h"
#include "small_comparisons.h"
#include "support/run_command.h"

namespace plumb::compare {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ComparisonTables, MarkWhatIsBroken) {
  const report::Table table = limits_table(testing::cracked_comparison(testing::cracked_pair()));
  ASSERT_EQ(table.rows.size(), 5u);
  EXPECT_EQ(table.rows[0].cells,
            (std::vector<std::string>{"coverage.holes", "BROKEN", "at most 0 px", "6 px", "inf",
                                      "(20, 8)"}));
  EXPECT_EQ(table.rows[0].kind, report::RowKind::Bad);
  EXPECT_EQ(table.rows[1].cells[4], "430 %");
  EXPECT_EQ(table.rows[2].kind, report::RowKind::Ok);
  EXPECT_EQ(table.rows[4].cells[0], "normal.largest_deg");
  EXPECT_EQ(table.rows[4].kind, report::RowKind::Plain);
}

TEST(ComparisonPage, IsWrittenWithItsPicturesAndItsJson) {
  const plumb::testing::TemporaryFolder folder;
  const PicturePair pair = testing::cracked_pair();
  const Comparison c = testing::cracked_comparison(pair);
  std::vector<std::string> files =
      write_comparison(folder.path() / "new" / "report", pair, c, "plumb compare a b");
  EXPECT_EQ(files, (std::vector<std::string>{"index.html", "comparison.json", "reference.png",
                                             "candidate.png", "difference.png",
                                             "colour-difference.png", "coverage.png"}));
  std::vector<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "new" / "report"))
    there.push_back(entry.path().filename().string());
  std::sort(files.begin(), files.end());
  std::sort(there.begin(), there.end());
  EXPECT_EQ(there, files);
  EXPECT_EQ(contents(folder.path() / "new" / "report" / "comparison.json"),
            comparison_json(c, "plumb compare a b"));
}

TEST(ComparisonPage, HoldsVerdictReasonsPicturesAndWorstPixels) {
  const plumb::testing::TemporaryFolder folder;
  const PicturePair pair = testing::cracked_pair();
  Comparison c = testing::cracked_comparison(pair);
  c.systematic = {{Systematic::Gain, "everything is twice as bright", 0.5, 0.01}};
  write_comparison(folder.path(), pair, c, "plumb compare a b");
  const std::string page = contents(folder.file("index.html"));
  EXPECT_TRUE(has(page, "<p class=\"verdict broken\"><strong>Fails</strong>"));
  EXPECT_TRUE(has(page, "<li>6 pixels show sky where terrain must be, the first at (20, 8)</li>"));
  EXPECT_TRUE(has(page, "everything is twice as bright"));
  EXPECT_LT(page.find("everything is twice as bright"), page.find("All that was measured"));
  EXPECT_TRUE(has(page, "data-name=\"reference\""));
  EXPECT_TRUE(has(page, "data-name=\"signed difference\""));
  EXPECT_TRUE(has(page, "alt=\"legend of colour difference\""));
  EXPECT_TRUE(has(page, "data-x=\"20\" data-y=\"8\">20, 8</a></td><td>hole</td>"));
  EXPECT_TRUE(has(page, "<td>Z 2050</td><td>Z inf</td>"));
  EXPECT_TRUE(has(page, "data:image/svg+xml;base64,"));
  // The crack's six pixels of 32 x 16 differ.
  EXPECT_TRUE(
      has(page, "largest difference of a channel; left out: 506 pixels without a difference."));
  EXPECT_TRUE(has(page, "&quot;schema&quot;: &quot;plumb.compare/1&quot;"));
}

// The coverage map's numbers are names of defects; the depth map is all zeros.
TEST(ComparisonPage, HasHistogramsOfSizesAlone) {
  const plumb::testing::TemporaryFolder folder;
  const PicturePair pair = testing::cracked_pair();
  Comparison c = testing::cracked_comparison(pair);
  c.maps.push_back({"coverage", "1: a hole", "", c.maps[0].values, 0.0});
  c.maps.push_back({"depth", "relative", "", std::vector<float>(pair.size(), 0.0f), 0.0});
  write_comparison(folder.path(), pair, c, "");
  const std::string page = contents(folder.file("index.html"));
  std::size_t charts = 0;
  for (std::size_t at = page.find("class=\"chart\""); at != std::string::npos;
       at = page.find("class=\"chart\"", at + 1))
    ++charts;
  EXPECT_EQ(charts, 1u);
  EXPECT_TRUE(has(page, "Without a finite difference above zero: depth."));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "depth.png"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "coverage-2.png"));
}

TEST(ComparisonPage, TakesNoNameForHtml) {
  const plumb::testing::TemporaryFolder folder;
  PicturePair pair = testing::cracked_pair();
  Comparison c = testing::cracked_comparison(pair);
  c.candidate_name = c.reference_name = c.profile = "<script>alert(1)</script>";
  c.reasons = c.notes = {c.profile};
  c.worst[0].reference = c.maps[0].name = c.maps[0].meaning = c.profile;
  write_comparison(folder.path(), pair, c, c.profile);
  EXPECT_FALSE(has(contents(folder.file("index.html")), "<script>alert"));
}

TEST(ComparisonPage, ShowsColoursWithoutDepthAndDepthWithoutColours) {
  const plumb::testing::TemporaryFolder folder;
  const PicturePair whole = testing::cracked_pair();
  Comparison c = testing::cracked_comparison(whole);
  c.coverage.reset();
  write_comparison(folder.path() / "colours", testing::colours_only(whole), c, "");
  EXPECT_TRUE(has(contents(folder.path() / "colours" / "index.html"),
                  "not known: neither depth nor alpha"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "colours" / "coverage.png"));
  write_comparison(folder.path() / "depth", testing::depth_only(whole), c, "");
  EXPECT_TRUE(has(contents(folder.path() / "depth" / "index.html"), "legend of reference"));
}

TEST(ComparisonPage, CannotBeWrittenWhereAFileStands) {
  const plumb::testing::TemporaryFolder folder;
  std::ofstream(folder.file("taken")) << "here";
  const PicturePair pair = testing::cracked_pair();
  const Comparison c = testing::cracked_comparison(pair);
  EXPECT_THROW(write_comparison(folder.path() / "taken", pair, c, ""), InputError);
}

TEST(FolderPage, LinksEachPairToItsOwnPage) {
  const plumb::testing::TemporaryFolder folder;
  const PicturePair pair = testing::cracked_pair();
  FolderComparison folders{"ref", "out", "default", {}, {{"lost.png", true}}, {}};
  folders.pairs.push_back({"a.png", testing::equal_comparison("a.png"), {}, {}});
  folders.pairs.push_back(write_folder_pair(folder.path(), "below/hill 1.exr", pair,
                                            testing::cracked_comparison(pair), "plumb compare"));
  EXPECT_TRUE(folders.pairs[1].comparison.maps.empty());
  write_folder_report(folder.path(), folders, "plumb compare ref out");
  const std::string page = contents(folder.file("index.html"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "pairs/below/hill 1.exr/index.html"));
  EXPECT_TRUE(has(
      page, "<a href=\"pairs/below/hill%201.exr/index.html\"><img src=\"data:image/png;base64,"));
  EXPECT_TRUE(has(page, "<td>lost.png</td><td>missing in the candidate</td>"));
  EXPECT_LT(page.find("lost.png"), page.find("hill 1.exr"));
  EXPECT_LT(page.find(">below/hill 1.exr<"), page.find(">a.png<"));
  EXPECT_TRUE(has(contents(folder.file("comparison.json")), "plumb.compare-folder/1"));
}

TEST(FolderPage, RefusesNamesThatLeadOutOfItsFolder) {
  const plumb::testing::TemporaryFolder folder;
  const PicturePair pair = testing::cracked_pair();
  const Comparison c = testing::cracked_comparison(pair);
  for (const char* name : {"../a.png", "/tmp/a.png", "a/../../b.png", ""})
    EXPECT_THROW(write_folder_pair(folder.path(), name, pair, c, ""), std::invalid_argument)
        << name;
}

}  // namespace
}  // namespace plumb::compare
