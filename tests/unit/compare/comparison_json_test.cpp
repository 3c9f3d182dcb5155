#include "compare/comparison_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "small_comparisons.h"

namespace plumb::compare {
namespace {

using Json = nlohmann::json;

Json cracked_json() {
  return Json::parse(
      comparison_json(testing::cracked_comparison(testing::cracked_pair()), "plumb compare a b"));
}

TEST(ComparisonJson, BeginsWithItsSchema) {
  const std::string text = comparison_json(testing::equal_comparison("a.png"), "c");
  EXPECT_EQ(text.rfind("{\n  \"schema\": \"plumb.compare/1\",\n  \"command\": \"c\",", 0), 0u)
      << text;
  EXPECT_TRUE(text.ends_with("}\n"));
}

TEST(ComparisonJson, HoldsWhatWasCompared) {
  const Json json = cracked_json();
  EXPECT_EQ(json["command"], "plumb compare a b");
  EXPECT_EQ(json["reference"], "ref/hill.exr");
  EXPECT_EQ(json["candidate"], "out/hill.exr");
  EXPECT_EQ(json["size_px"], Json::array({32, 16}));
  EXPECT_EQ(json["encoding"], "linear, floats");
  EXPECT_EQ(json["channels"], Json::array({"R", "G", "B", "Z"}));
  EXPECT_EQ(json["profile"], "default");
  EXPECT_EQ(json["verdict"], "fails");
  EXPECT_EQ(json["reasons"].size(), 2u);
  EXPECT_EQ(json["not_judged"], Json::array({"normal.largest_deg"}));
  EXPECT_EQ(json["notes"], Json::array({"the eye is 0.5 m off"}));
}

TEST(ComparisonJson, HoldsEachLimitWithWhatWasMeasured) {
  const Json judgement = cracked_json()["judgements"][1];
  EXPECT_EQ(judgement["limit"], "colour.largest");
  EXPECT_EQ(judgement["sense"], "at most");
  EXPECT_EQ(judgement["bound"], 0.1);
  EXPECT_EQ(judgement["measured"], 0.43);
  EXPECT_EQ(judgement["holds"], false);
  EXPECT_EQ(judgement["pixel"], Json::array({20, 8}));
  EXPECT_EQ(cracked_json()["judgements"][0]["sense"], "at least");
}

TEST(ComparisonJson, HoldsEveryMeasurement) {
  const Json all = cracked_json()["measurements"];
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all[1]["name"], "colour.share_over(0.02)");
  EXPECT_EQ(all[1]["threshold"], 0.02);
  EXPECT_EQ(all[1]["unit"], "%");
  EXPECT_EQ(all[1]["pixel"], nullptr);
  EXPECT_EQ(all[5]["channel"], "N.X");
  EXPECT_EQ(all[5]["value"], 0.0);
}

TEST(ComparisonJson, WritesWhatIsInfiniteAsNull) {
  Comparison c = testing::equal_comparison("a.png");
  c.judgements = {testing::judged(
      {"colour", "", "largest", {}, std::numeric_limits<double>::infinity()}, 0.0, false)};
  const Json json = Json::parse(comparison_json(c, ""));
  EXPECT_EQ(json["measurements"][1]["value"], nullptr);  // PSNR of equal pictures
  EXPECT_EQ(json["judgements"][0]["measured"], nullptr);
  EXPECT_EQ(json["judgements"][0]["use"], nullptr);
}

// 4 rows of sky with a border of one row that is undecided on both sides: rows 0 to 2 must be sky,
// rows 5 to 15 terrain. The crack's six pixels are holes.
TEST(ComparisonJson, HoldsCoverageNumbersMaskAndWorstPixels) {
  Comparison c = testing::cracked_comparison(testing::cracked_pair());
  EXPECT_EQ(Json::parse(comparison_json(c, ""))["mask"], nullptr);
  c.mask = MaskReport{10, 4, 2};
  c.numbers = {7, 1, "channel R at (0, 0): nan, reference 0.5"};
  c.systematic = {{Systematic::Shift, "shifted by half a pixel", 0.5, 0.01}};
  const Json json = Json::parse(comparison_json(c, ""));
  EXPECT_EQ(json["coverage"]["holes"], 6);
  EXPECT_EQ(json["coverage"]["must_be_sky"], 3 * 32);
  EXPECT_EQ(json["coverage"]["must_be_terrain"], 11 * 32);
  EXPECT_EQ(json["mask"]["would_fail"], 2);
  EXPECT_EQ(json["not_finite"]["alike"], 7);
  EXPECT_EQ(json["not_finite"]["unlike"], 1);
  EXPECT_EQ(json["not_finite"]["first"], "channel R at (0, 0): nan, reference 0.5");
  EXPECT_EQ(json["systematic"][0]["kind"], "shift");
  EXPECT_EQ(json["systematic"][0]["rms_after"], 0.01);
  EXPECT_EQ(json["worst"][0]["pixel"], Json::array({20, 8}));
  EXPECT_EQ(json["worst"][0]["candidate"], "Z inf");
}

TEST(ComparisonJson, SurvivesNamesThatAreNoText) {
  Comparison c = testing::equal_comparison("a\xff.png");
  const Json json = Json::parse(comparison_json(c, ""));
  EXPECT_EQ(json["reference"], "ref/a\xEF\xBF\xBD.png");
}

TEST(FolderJson, CountsAndSortsPairs) {
  FolderComparison folders{"ref",
                           "out",
                           "default",
                           {},
                           {{"lost.png", true}, {"new.png", false}},
                           {{"broken.png", "unreadable"}}};
  folders.pairs.push_back({"a.png", testing::equal_comparison("a.png")});
  folders.pairs.push_back({"b.exr", testing::cracked_comparison(testing::cracked_pair())});
  const Json json = Json::parse(folder_json(folders, "plumb compare ref out"));
  EXPECT_EQ(json["schema"], "plumb.compare-folder/1");
  EXPECT_EQ(json["verdict"], "none");
  EXPECT_EQ(json["counts"]["fail"], 1);
  EXPECT_EQ(json["counts"]["equal"], 1);
  EXPECT_EQ(json["counts"]["missing"], 2);
  EXPECT_EQ(json["missing"][0]["missing_in"], "candidate");
  EXPECT_EQ(json["missing"][1]["missing_in"], "reference");
  EXPECT_EQ(json["errors"][0]["message"], "unreadable");
  ASSERT_EQ(json["pairs"].size(), 2u);
  EXPECT_EQ(json["pairs"][0]["name"], "b.exr");
  EXPECT_EQ(json["pairs"][0]["comparison"]["schema"], "plumb.compare/1");
  EXPECT_EQ(json["pairs"][0]["comparison"]["verdict"], "fails");
}

}  // namespace
}  // namespace plumb::compare
