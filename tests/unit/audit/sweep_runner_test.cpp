#include "audit/sweep/runner.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "audit/sweep/result_file.h"
#include "audit/sweep/shared_works.h"
#include "unit/audit/small_sweeps.h"

namespace plumb::audit::sweep {
namespace {

ResultLine parsed(const std::string& line) {
  return parse_results(line + "\n", "line").lines.at(0);
}

// Without timing, sorted.
std::vector<std::string> results_of(const std::vector<std::string>& lines) {
  std::vector<std::string> results;
  for (const std::string& line : lines) results.push_back(result_text(parsed(line)));
  std::sort(results.begin(), results.end());
  return results;
}

TEST(SweepRunner, MakesTheSameLinesOnAnyNumberOfThreads) {
  const MethodTable table = small_methods();
  const SweepPlan plan = small_plan(kSmallSweep, table);
  const auto one = results_of(lines_of(plan, all_runs(plan), table));
  EXPECT_EQ(one.size(), 12u);
  EXPECT_EQ(one, results_of(lines_of(plan, all_runs(plan), table, {.threads = 4})));
  EXPECT_EQ(one, results_of(lines_of(plan, all_runs(plan), table, {.draws = 3})));
  EXPECT_EQ(one, results_of(lines_of(plan, all_runs(plan), table, {.frame_bytes = 0})));
}

TEST(SweepRunner, MakesTheSameLineAloneAndAmongOthers) {
  const MethodTable table = small_methods();
  const SweepPlan plan = small_plan(kSmallSweep, table);
  const auto all = results_of(lines_of(plan, all_runs(plan), table));
  const auto alone = results_of(lines_of(plan, {7}, table));
  EXPECT_NE(std::find(all.begin(), all.end(), alone.at(0)), all.end());
}

// Two terrains: two groups of six runs.
TEST(SweepRunner, PreparesAMethodOnceForATerrain) {
  for (const int threads : {1, 3}) {
    std::atomic<int> prepared = 0;
    const MethodTable table = small_methods(&prepared);
    const SweepPlan plan = small_plan(kSmallSweep, table);
    lines_of(plan, all_runs(plan), table, {.threads = threads});
    EXPECT_EQ(prepared, 2);
  }
}

TEST(SweepRunner, GoesOnAfterARunThatFails) {
  const MethodTable table = small_methods();
  const SweepPlan plan = small_plan(R"(terrains = ["generate:plane?size=5"]
methods = ["exact", "refuses"]
tolerances_px = [1, 13, 2]
width = 16
height = 9)",
                                    table);
  std::vector<ResultLine> lines;
  for (const std::string& line : lines_of(plan, all_runs(plan), table))
    lines.push_back(parsed(line));
  ASSERT_EQ(lines.size(), 6u);
  std::sort(lines.begin(), lines.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  EXPECT_EQ(lines[0].status, "done");
  EXPECT_EQ(lines[1].status, "failed");
  EXPECT_EQ(lines[1].error, "thirteen is no tolerance");
  EXPECT_EQ(lines[2].status, "done");
  for (std::size_t k = 3; k < 6; ++k) EXPECT_EQ(lines[k].error, "not today");
}

TEST(SweepRunner, StopsWhereLinesCannotBeKept) {
  const MethodTable table = small_methods();
  const SweepPlan plan = small_plan(kSmallSweep, table);
  int told = 0;
  const auto listener = [&](const std::string&) {
    if (++told == 3) input_error("the disk is full");
  };
  EXPECT_THROW(run_sweep(plan, all_runs(plan), table, {.threads = 2}, listener), InputError);
  EXPECT_EQ(told, 3);
}

// Each of three works has 4 bytes: two fit into 8.
TEST(SharedWorks, ForgetsTheLeastLatelyUsed) {
  SharedWorks<int> works(8);
  int made = 0;
  const auto get = [&](const std::string& name) {
    return *works.get(name, 4, [&] { return std::make_shared<const int>(++made); });
  };
  EXPECT_EQ(get("a"), 1);
  EXPECT_EQ(get("b"), 2);
  EXPECT_EQ(get("a"), 1);
  EXPECT_EQ(get("c"), 3);  // b goes
  EXPECT_EQ(get("a"), 1);
  EXPECT_EQ(get("b"), 4);
}

}  // namespace
}  // namespace plumb::audit::sweep
