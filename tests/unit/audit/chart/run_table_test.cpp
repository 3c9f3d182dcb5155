#include "audit/chart/run_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "audit/chart/camera_paths.h"
#include "audit/chart/chart_data.h"
#include "audit/chart/scales.h"
#include "core/check.h"
#include "support/sweep_lines.h"

namespace plumb::audit::chart {
namespace {

using testing::line_of;
using testing::MadeUpRun;

constexpr std::size_t kCpu = 0, kTriangles = 3, kSlices = 5, kEncoded = 9;

std::string message_of(const std::string& text) {
  try {
    parse_runs(text, "results.jsonl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(RunTable, HasFinishedRunsAndListsTheOthers) {
  const RunTable table =
      parse_runs(line_of({.camera = "a"}) + line_of({.camera = "b", .status = "failed"}) +
                     line_of({.camera = "c", .status = "skipped"}),
                 "r");
  EXPECT_EQ(table.runs.size(), 1u);
  ASSERT_EQ(table.failed.size(), 1u);
  EXPECT_EQ(table.failed[0].error, "made up");
  EXPECT_NE(table.failed[0].what.find("hills, full"), std::string::npos);
  EXPECT_EQ(table.skipped.size(), 1u);
}

TEST(RunTable, TakesANullBesideACountForAnInfiniteError) {
  const RunTable table = parse_runs(line_of({.error_px = std::nullopt}), "r");
  ASSERT_TRUE(table.runs[0].error_px);
  EXPECT_TRUE(std::isinf(*table.runs[0].error_px));
  EXPECT_TRUE(std::isinf(table.runs[0].claims.at(0).measured));
  EXPECT_FALSE(table.runs[0].claims[0].holds);
}

// Caves claim the nearest point in a picture, and nothing up or down.
TEST(RunTable, ShowsANearestErrorWithPixelErrorsWhereThereIsNone) {
  std::string line = line_of({});
  const std::size_t at = line.find("pixel-error");
  ASSERT_NE(at, std::string::npos);
  line.replace(at, 11, "nearest-error");
  EXPECT_EQ(parse_runs(line, "r").runs[0].claims.at(0).measure, "pixel-error");
}

TEST(RunTable, HasNoErrorOfAViewOfNothing) {
  EXPECT_FALSE(parse_runs(line_of({.empty = true}), "r").runs[0].error_px);
}

TEST(RunTable, CountsRoundingAsNone) {
  EXPECT_EQ(parse_runs(line_of({.error_px = 9e-7}), "r").runs[0].error_px, 0.0);
  EXPECT_EQ(parse_runs(line_of({.error_px = 2e-6}), "r").runs[0].error_px, 2e-6);
}

// What slices cost their triangles do not tell; a file that is not there has no size.
TEST(RunTable, HasNoCostWhereItDoesNotApply) {
  const RunTable table =
      parse_runs(line_of({.method = "a"}) + line_of({.method = "b", .slices = 8}) +
                     line_of({.method = "b", .camera = "top"}),
                 "r");
  EXPECT_EQ(table.runs[0].costs[kTriangles], 1000);
  EXPECT_FALSE(table.runs[0].costs[kSlices]);
  EXPECT_FALSE(table.runs[1].costs[kTriangles]);
  EXPECT_EQ(table.runs[1].costs[kSlices], 8);
  EXPECT_FALSE(table.runs[2].costs[kTriangles]);  // slices elsewhere: not to be compared
  EXPECT_FALSE(table.runs[0].costs[kEncoded]);
}

TEST(RunTable, LeavesATornLastLineOut) {
  const std::string whole = line_of({.camera = "a"}), second = line_of({.camera = "b"});
  const RunTable table = parse_runs(whole + second.substr(0, second.size() - 1), "r");
  EXPECT_TRUE(table.torn);
  EXPECT_EQ(table.runs.size(), 1u);
  EXPECT_FALSE(parse_runs(whole, "r").torn);
}

TEST(RunTable, CountsARunOnceHoweverOftenItStandsThere) {
  const RunTable table = parse_runs(line_of({}) + line_of({}), "r");
  EXPECT_EQ(table.runs.size(), 1u);
  EXPECT_EQ(table.repeated, 1);
}

TEST(RunTable, NamesSeriesByWhatTellsThemApart) {
  const RunTable table = parse_runs(
      line_of({.method = "b", .variant = "y"}) + line_of({.method = "b", .variant = "x"}) +
          line_of({.method = "a"}) + line_of({.method = "b", .variant = "x", .unit = "m"}),
      "r");
  ASSERT_EQ(table.series.size(), 4u);
  EXPECT_EQ(table.series[0].name, "a");
  EXPECT_EQ(table.series[1].name, "b x, tolerance in m");
  EXPECT_EQ(table.series[2].name, "b x, tolerance in px");
  EXPECT_EQ(table.runs[0].series, 3);
  const std::vector<SeriesLook> looks = looks_of(table);
  EXPECT_NE(looks[0].shape, looks[1].shape);
  EXPECT_EQ(looks[1].shape, looks[2].shape);
  EXPECT_NE(looks[1].dash, looks[2].dash);
}

TEST(RunTable, SaysInOneLineWhatIsWrong) {
  EXPECT_NE(message_of("").find("is empty"), std::string::npos);
  EXPECT_NE(message_of("{\n").find("line 1"), std::string::npos);
  EXPECT_NE(message_of("{\"schema\":\"plumb.audit/1\"}\n").find("plumb.sweep/1"),
            std::string::npos);
  EXPECT_NE(message_of(line_of({.status = "failed"})).find("no finished run (1 failed"),
            std::string::npos);
}

// Alone, CPU time says something; while others run, triangles are the better first choice.
TEST(Looks, OfAMethodAreTheSameWhateverStandsBesideIt) {
  const RunTable one = parse_runs(line_of({.method = "stacks"}), "r"),
                 two = parse_runs(line_of({.method = "aardvark"}) + line_of({.method = "stacks"}),
                                  "r");
  EXPECT_EQ(looks_of(one)[0].colour, looks_of(two)[1].colour);
  EXPECT_EQ(looks_of(one)[0].shape, looks_of(two)[1].shape);
  EXPECT_NE(looks_of(two)[0].shape, looks_of(two)[1].shape);
}

TEST(FirstCost, IsATimeOnlyWhereOneWasTakenAlone) {
  EXPECT_EQ(first_cost(parse_runs(line_of({}), "r")), kCpu);
  EXPECT_EQ(first_cost(parse_runs(line_of({.shared = true}), "r")), kTriangles);
}

TEST(CameraPaths, AreRunsThatBelongTogetherInTime) {
  const RunTable table = parse_runs(line_of({}) + line_of({.camera = "fly", .frame = 1}) +
                                        line_of({.camera = "fly", .frame = 3}) +
                                        line_of({.tolerance = 4, .camera = "fly", .frame = 3}),
                                    "r");
  const std::vector<CameraPath> paths = paths_of(table);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_EQ(paths[0].title, "hills \xC2\xB7 fly");
  EXPECT_EQ(paths[0].frames.low, 1);
  EXPECT_EQ(paths[0].frames.high, 3);
  const std::vector<Asked> asked = asked_on_paths(table);
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(first_asked(asked), 0u);  // two runs against one
}

TEST(ChartData, HasTheSameBytesForTheSameRuns) {
  const std::string text = line_of({.error_px = 0.0}) + line_of({.method = "b", .popping_px = 2});
  const auto data_of = [&] {
    const RunTable table = parse_runs(text, "r");
    return chart_data(table, settings_of(table), kCpu);
  };
  EXPECT_EQ(data_of(), data_of());
}

}  // namespace
}  // namespace plumb::audit::chart
