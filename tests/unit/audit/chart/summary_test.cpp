#include "audit/chart/summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "audit/chart/winners.h"
#include "support/sweep_lines.h"

namespace plumb::audit::chart {
namespace {

using testing::line_of;
using testing::MadeUpRun;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kCpu = 0, kTriangles = 3;

RunTable table_of(const std::vector<MadeUpRun>& runs) {
  std::string text;
  for (const MadeUpRun& run : runs) text += line_of(run);
  return parse_runs(text, "made up");
}

std::vector<int> front_of(const std::vector<ErrorAndCost>& points) { return pareto_front(points); }

//  cost
//   5  a
//   3     b  c      c costs the same as b and is worse; d is worse than e in both
//   2           d
//   1        e
TEST(ParetoFront, HasWhatNoOtherPointBeats) {
  EXPECT_EQ(front_of({{0, 5}, {1, 3}, {2, 3}, {4, 2}, {3, 1}}), (std::vector<int>{0, 1, 4}));
}

TEST(ParetoFront, HasAllOfEqualPoints) {
  EXPECT_EQ(front_of({{1, 3}, {2, 2}, {1, 3}}), (std::vector<int>{0, 2, 1}));
}

TEST(ParetoFront, HasNothingInfiniteOrMissing) {
  EXPECT_EQ(front_of({{kInfinite, 1}, {1, 2}, {0, NAN}}), std::vector<int>{1});
  EXPECT_TRUE(front_of({}).empty());
}

TEST(Median, IsTheMiddleOrBetweenTheMiddleTwo) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({1, kInfinite, 2}), 2);
  EXPECT_EQ(median({1, kInfinite}), kInfinite);
  EXPECT_THROW(median({}), std::invalid_argument);
}

// Three views; the middle error and the middle time need not be those of one view.
TEST(Settings, AreMediansOverTheViewsOfATolerance) {
  const RunTable table = table_of({{.camera = "a", .error_px = 1, .cpu_s = 9},
                                   {.camera = "b", .error_px = 2, .cpu_s = 5},
                                   {.camera = "c", .error_px = 7, .cpu_s = 4},
                                   {.tolerance = 2, .camera = "a", .error_px = 8, .cpu_s = 1}});
  const std::vector<Setting> settings = settings_of(table);
  ASSERT_EQ(settings.size(), 2u);
  EXPECT_EQ(settings[0].runs, 3);
  EXPECT_EQ(settings[0].error_px, 2);
  EXPECT_EQ(settings[0].costs[kCpu], 5);
  EXPECT_EQ(settings[1].error_px, 8);
}

// The view of nothing is cheap, and would halve the median.
TEST(Settings, LeaveViewsOfNothingOut) {
  const std::vector<Setting> settings = settings_of(table_of(
      {{.camera = "a", .error_px = 1, .cpu_s = 4}, {.camera = "b", .empty = true, .cpu_s = 2}}));
  ASSERT_EQ(settings.size(), 1u);
  EXPECT_EQ(settings[0].runs, 1);
  EXPECT_EQ(settings[0].error_px, 1);
  EXPECT_EQ(settings[0].costs[kCpu], 4);
}

// "dear" has the error and the triangles of "cheap" doubled, but over another terrain.
TEST(Settings, HaveAFrontForEachTerrainByItself) {
  const std::vector<Setting> settings = settings_of(table_of(
      {{.terrain = "hills", .method = "cheap", .error_px = 1, .triangles = 10},
       {.terrain = "hills", .method = "worse", .error_px = 2, .triangles = 20},
       {.terrain = "alps", .kind = "alpine", .method = "dear", .error_px = 2, .triangles = 20}}));
  ASSERT_EQ(settings.size(), 3u);
  EXPECT_TRUE(settings[0].on_front[kTriangles]);   // cheap
  EXPECT_FALSE(settings[1].on_front[kTriangles]);  // worse
  EXPECT_TRUE(settings[2].on_front[kTriangles]);   // dear
}

const Winner& at(const std::vector<Winner>& winners, int kind, double limit_px) {
  for (const Winner& winner : winners)
    if (winner.kind == kind && winner.limit_px == limit_px) return winner;
  throw std::out_of_range("no such winner");
}

TEST(Winners, AreTheCheapestThatKeepAnErrorInEveryView) {
  const RunTable table =
      table_of({{.method = "exact", .camera = "a", .error_px = 0, .triangles = 100},
                {.method = "exact", .camera = "b", .error_px = 0, .triangles = 100},
                {.method = "rough", .camera = "a", .error_px = 0.5, .triangles = 20},
                {.method = "rough", .camera = "b", .error_px = 2, .triangles = 20}});
  const std::vector<Winner> winners = winners_of(table, kTriangles);
  EXPECT_EQ(winners.size(), kErrorLimits.size());
  EXPECT_EQ(at(winners, 0, 1).series, 0);  // exact: rough has 2 px in view b
  EXPECT_EQ(at(winners, 0, 1).second, -1);
  EXPECT_EQ(at(winners, 0, 2).series, 1);
  EXPECT_EQ(at(winners, 0, 2).second, 0);
  EXPECT_EQ(at(winners, 0, 2).times_cheaper, 5);
}

TEST(Winners, HaveFinishedEveryViewOfTheKind) {
  const RunTable table = table_of({{.method = "all", .camera = "a", .triangles = 100},
                                   {.method = "all", .camera = "b", .triangles = 100},
                                   {.method = "part", .camera = "a", .triangles = 1},
                                   {.method = "part", .camera = "b", .status = "failed"}});
  EXPECT_EQ(at(winners_of(table, kTriangles), 0, 8).series, 0);
}

TEST(Winners, AreNoneWhereNoneKeepsTheError) {
  const RunTable table = table_of({{.error_px = std::nullopt}});
  EXPECT_EQ(at(winners_of(table, kCpu), 0, 8).series, -1);
}

TEST(Kinds, StandInTheUsualOrder) {
  const RunTable table = table_of({{.terrain = "x", .kind = "mine"},
                                   {.terrain = "y", .kind = "caves"},
                                   {.terrain = "z", .kind = "alpine"}});
  EXPECT_EQ(kinds_of(table), (std::vector<std::string>{"alpine", "caves", "mine"}));
}

}  // namespace
}  // namespace plumb::audit::chart
