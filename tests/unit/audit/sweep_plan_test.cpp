#include "audit/sweep/plan.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/audit/small_sweeps.h"

namespace plumb::audit::sweep {
namespace {

std::vector<std::string> names_of(const SweepPlan& plan) {
  std::vector<std::string> names;
  for (const PlannedRun& run : plan.runs) names.push_back(name_of(plan, run));
  return names;
}

// Published test vectors of FNV-1a, 64 bits.
TEST(SweepKey, IsFnv1a) {
  EXPECT_EQ(key_of(""), "cbf29ce484222325");
  EXPECT_EQ(key_of("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(key_of("foobar"), "85944171f73967e8");
}

TEST(SweepPlan, OrdersByTerrainToleranceAndCamera) {
  const std::vector<std::string> names = names_of(small_plan(kSmallSweep, small_methods()));
  ASSERT_EQ(names.size(), 12u);
  EXPECT_EQ(names[0], "plane, exact, conservative, 1px, oblique");
  EXPECT_EQ(names[1], "plane, exact, conservative, 1px, top");
  EXPECT_EQ(names[2], "plane, exact, conservative, 2px, oblique");
  EXPECT_EQ(names[6], "step, exact, conservative, 1px, oblique");
}

TEST(SweepPlan, GivesEachRunAKeyThatTheVersionAndTheTerrainChange) {
  const MethodTable table = small_methods();
  const SweepPlan plan = small_plan(kSmallSweep, table);
  std::set<std::string> keys;
  for (const PlannedRun& run : plan.runs) keys.insert(run.key);
  EXPECT_EQ(keys.size(), 12u);
  EXPECT_EQ(small_plan(kSmallSweep, table).runs[3].key, plan.runs[3].key);
  for (const PlannedRun& run : small_plan(kSmallSweep, table, "2").runs)
    EXPECT_FALSE(keys.contains(run.key));
  std::string higher = kSmallSweep;
  higher.replace(higher.find("plane?size=5"), 12, "plane?size=5&height=7");
  const SweepPlan moved = small_plan(higher, table);
  EXPECT_FALSE(keys.contains(moved.runs[0].key));
  EXPECT_TRUE(keys.contains(moved.runs[6].key));  // the step is the same
}

TEST(SweepPlan, SkipsWhatAMethodLacks) {
  MethodTable table = small_methods();
  table.back().variants = {"conservative", "published"};
  const SweepPlan plan = small_plan(R"(terrains = ["generate:plane?size=5", "generate:caves?size=9"]
methods = ["exact"]
variants = ["conservative", "published"]
tolerances_px = [1]
tolerances_m = [2])",
                                    table);
  ASSERT_EQ(plan.runs.size(), 8u);
  EXPECT_EQ(plan.runs[0].skipped, "");
  EXPECT_EQ(plan.runs[1].skipped, "method exact promises nothing in 'm': its tolerances are in px");
  EXPECT_EQ(plan.runs[2].skipped, "method exact has no variant 'published': it has conservative");
  EXPECT_EQ(plan.runs[4].skipped, "method exact draws heights, and caves is a terrain of stacks");
}

TEST(SweepPlan, RunsVariantsOfSizesWithSizes) {
  MethodTable table = small_methods();
  table.front().variants = {"conservative", "published"};
  table.front().size_variants = {"published"};
  const std::string scene = R"(terrains = ["generate:plane?size=5"]
methods = ["exact"]
variants = ["conservative", "published"]
tolerances_px = [1, 2]
)";
  const std::vector<std::string> with = names_of(small_plan(scene + "sizes_px = [160]", table));
  ASSERT_EQ(with.size(), 3u);
  EXPECT_EQ(with[1], "plane, exact, conservative, 2px, oblique");
  EXPECT_EQ(with[2], "plane, exact, published, 160px, oblique");
  EXPECT_EQ(small_plan(scene, table).runs.size(), 4u);
}

TEST(SweepPlan, RefusesTwoRunsThatAskForTheSame) {
  EXPECT_THROW(
      small_plan(std::string("terrains = [\"generate:plane?size=5\"]\nmethods = [\"exact\"]\n"
                             "[[parameters.exact]]\n[[parameters.exact]]\n"),
                 small_methods()),
      InputError);
}

TEST(SweepPlan, NamesTheAuditThatMakesARunAgain) {
  const MethodTable& table = built_in_methods();
  const SweepPlan plan = small_plan(
      R"(terrains = [{ source = "generate:plane?size=5", window = [0, 0, 3, 3], diagonal = "fixed" }]
methods = ["slicing"]
cameras = [{ name = "low", preset = "oblique", fov_y_deg = 20 }]
width = 16
height = 9
[parameters.slicing]
leaf_cells = 4)",
      table);
  const std::string source = plan.terrains[0].source;
  EXPECT_EQ(command_of(plan, plan.runs[0]),
            "plumb audit '" + source +
                "' --window 0,0,3,3 --diagonal fixed --method slicing --variant conservative --set "
                "leaf_cells=4 --tolerance 1px --camera '{ preset = \"oblique\", fov_y_deg = 20.0 "
                "}' --size 16x9");
}

// Twelve runs in five parts: 3, 3, 2, 2, 2.
TEST(SweepShard, GivesEachRunToOnePart) {
  const SweepPlan plan = small_plan(kSmallSweep, small_methods());
  std::set<std::size_t> given;
  for (int part = 1; part <= 5; ++part) {
    const std::vector<std::size_t> runs = shard_of(plan, part, 5);
    EXPECT_GE(runs.size(), 2u);
    EXPECT_LE(runs.size(), 3u);
    given.insert(runs.begin(), runs.end());
  }
  EXPECT_EQ(given.size(), 12u);
}

// Three tolerances of two views are six runs; of six parts none has one place of the six alone.
TEST(SweepShard, GivesNoPartTheSameToleranceOfEveryTerrain) {
  const SweepPlan plan = small_plan(kSmallSweep, small_methods());
  for (int part = 1; part <= 6; ++part) {
    const std::vector<std::size_t> runs = shard_of(plan, part, 6);
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_NE(runs[0] % 6, runs[1] % 6);
  }
}

}  // namespace
}  // namespace plumb::audit::sweep
