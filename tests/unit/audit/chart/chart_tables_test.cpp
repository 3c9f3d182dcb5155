#include "audit/chart/chart_tables.h"

#include <gtest/gtest.h>

#include <limits>

#include "audit/chart/broken_claims.h"
#include "audit/chart/winners.h"
#include "support/sweep_lines.h"

namespace plumb::audit::chart {
namespace {

using testing::line_of;
using testing::MadeUpRun;

RunTable table_of(const std::vector<MadeUpRun>& runs) {
  std::string text;
  for (const MadeUpRun& run : runs) text += line_of(run);
  return parse_runs(text, "made up");
}

// What coverage and patches say stands in no MadeUpRun.
std::string with_wrong_pixels(std::string line, int pixels) {
  const std::string claims = "\"claims\":[";
  line.insert(line.find(claims) + claims.size(),
              R"({"measure":"coverage","by":"method","scope":"frame","claimed":0,"unit":"",)"
              R"("measured":)" +
                  std::to_string(pixels) + R"(,"holds":false},)");
  return line;
}

TEST(BrokenClaims, AreCountedWithTheWorst) {
  const RunTable table = table_of({{.camera = "a", .error_px = 0.5, .claimed_px = 1},
                                   {.camera = "b", .error_px = 3, .claimed_px = 1},
                                   {.camera = "c", .error_px = 5, .claimed_px = 2}});
  const std::vector<BrokenClaims> all = broken_claims(table);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].judged, 3);
  EXPECT_EQ(all[0].broken, 2);
  EXPECT_EQ(all[0].by_error, 2);
  EXPECT_EQ(all[0].worst_ratio, 3.0);
  EXPECT_EQ(all[0].worst_run, 1);
  EXPECT_EQ(all[0].by_coverage, 0);
}

TEST(BrokenClaims, ByWrongPixelsAreCountedByThemselves) {
  const std::string line = line_of({.camera = "a", .error_px = 0.5, .claimed_px = 1});
  const BrokenClaims claims =
      broken_claims(parse_runs(with_wrong_pixels(line, 7), "made up")).at(0);
  EXPECT_EQ(claims.by_coverage, 1);
  EXPECT_EQ(claims.most_pixels, 7.0);
  EXPECT_EQ(claims.by_error, 0);
}

TEST(BrokenClaims, OfZeroAreBrokenWithoutEnd) {
  const BrokenClaims claims = broken_claims(table_of({{.error_px = 0.5, .claimed_px = 0}})).at(0);
  EXPECT_EQ(claims.worst_ratio, std::numeric_limits<double>::infinity());
}

TEST(Cheapest, IsOfEachSeriesThatKeepsTheErrorInEveryView) {
  const RunTable table = table_of({{.method = "full", .tolerance = 1, .error_px = 0, .cpu_s = 9},
                                   {.method = "slow", .tolerance = 1, .error_px = 0.9, .cpu_s = 4},
                                   {.method = "slow", .tolerance = 2, .error_px = 2, .cpu_s = 3}});
  std::vector<std::string> found;
  for (const Cheapest& one : cheapest_of(table, 0)) {
    if (one.limit_px == 0.5 || one.limit_px == 2.0)
      found.push_back(table.series[static_cast<std::size_t>(one.series)].method + " " +
                      std::to_string(static_cast<int>(one.cost)));
  }
  EXPECT_EQ(found, (std::vector<std::string>{"full 9", "slow 3", "full 9"}));
}

TEST(ChartTables, NameTheWorstAndTheCost) {
  const std::string text = chart_tables(
      table_of({{.tolerance = 1, .camera = "valley", .error_px = 3, .claimed_px = 1, .cpu_s = 4}}),
      0, "plumb chart r");
  EXPECT_NE(text.find("Made by `plumb chart r` of 1 runs."), std::string::npos);
  EXPECT_NE(text.find("3 × (pixel-error: 3 px where 1 was claimed, valley)"), std::string::npos);
  EXPECT_NE(text.find("| - | - | - | - | - | 4 (1) | 4 (1) |"), std::string::npos);
}

}  // namespace
}  // namespace plumb::audit::chart
