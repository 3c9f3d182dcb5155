#include "audit/plan/terrain_plan.h"

#include <gtest/gtest.h>

#include <optional>

namespace plumb::audit::plan {
namespace {

constexpr std::size_t kTriangleCost = 3;

// Two methods over one terrain from four cameras: "coarse" at 1 and at 4 px, "full".
class Table {
 public:
  Table() {
    table_.terrains = {{"hills", "alpine"}};
    table_.series = {{"coarse", "published", "", "px", "coarse"},
                     {"full", "conservative", "", "px", "full"}};
    table_.cameras = {"a", "b", "c", "d"};
  }
  Table& add(int series, double tolerance, int camera, std::optional<double> error_px,
             double triangles, const std::string& verdict = "held") {
    chart::Run run;
    run.series = series;
    run.camera = camera;
    run.tolerance = tolerance;
    run.error_px = error_px;
    run.costs[kTriangleCost] = triangles;
    run.verdict = verdict;
    table_.runs.push_back(run);
    return *this;
  }
  // The same error and triangles from every camera.
  Table& add_all(int series, double tolerance, double error_px, double triangles) {
    for (int camera = 0; camera < 4; ++camera) add(series, tolerance, camera, error_px, triangles);
    return *this;
  }
  const chart::RunTable& table() const { return table_; }

 private:
  chart::RunTable table_;
};

PlanOptions one_pixel() {
  PlanOptions options;
  options.error_px = 1.0;
  options.cost = kTriangleCost;
  return options;
}

TEST(TerrainPlan, TakesTheCheapestSettingAndSaysWhatOthersCost) {
  Table runs;
  runs.add_all(0, 4.0, 1.5, 10)
      .add_all(0, 1.0, 0.7, 40)
      .add_all(0, 0.5, 0.3, 90)
      .add_all(1, 1.0, 0.0, 500);
  const TerrainPlan plan = plans_of(runs.table(), one_pixel()).at(0);
  EXPECT_EQ(plan.views, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(plan.held_out, (std::vector<std::size_t>{3}));
  ASSERT_TRUE(plan.choice.best);
  EXPECT_EQ(name_of(runs.table(), plan.settings[plan.choice.best->candidate]),
            "coarse, published, at 1 px");
  EXPECT_EQ(plan.choice.best->cost, 40.0);
  EXPECT_EQ(plan.choice.runner_up->cost, 500.0);
  ASSERT_EQ(plan.otherwise.size(), 2u);
  EXPECT_EQ(plan.otherwise[0].cost, 90.0);
  EXPECT_EQ(plan.otherwise[1].cost, 500.0);
  EXPECT_TRUE(is_met({plan}, one_pixel()));
}

TEST(TerrainPlan, IsNotMetWhereAViewHeldOutIsOverTheError) {
  Table runs;
  for (int camera = 0; camera < 3; ++camera) runs.add(0, 1.0, camera, 0.5, 10);
  runs.add(0, 1.0, 3, 1.25, 10);
  const TerrainPlan plan = plans_of(runs.table(), one_pixel()).at(0);
  ASSERT_TRUE(plan.choice.held_out);
  EXPECT_EQ(plan.choice.held_out->error, 1.25);
  EXPECT_FALSE(is_met({plan}, one_pixel()));
}

TEST(TerrainPlan, IsNotMetWhereNothingKeepsTheError) {
  Table runs;
  runs.add_all(0, 4.0, 1.5, 10);
  const TerrainPlan plan = plans_of(runs.table(), one_pixel()).at(0);
  EXPECT_FALSE(plan.choice.best);
  EXPECT_EQ(plan.choice.nearest->error, 1.5);
  EXPECT_FALSE(is_met({plan}, one_pixel()));
}

TEST(TerrainPlan, PassesOverRunsWithoutAnErrorAndThoseThatBrokeAClaim) {
  Table runs;
  runs.add_all(1, 1.0, 0.0, 500);
  for (int camera = 0; camera < 4; ++camera) runs.add(0, 1.0, camera, std::nullopt, 1);
  for (int camera = 0; camera < 4; ++camera) runs.add(0, 4.0, camera, 0.1, 2, "broken");
  EXPECT_EQ(plans_of(runs.table(), one_pixel()).at(0).choice.best->cost, 500.0);
}

TEST(TerrainPlan, IsOfAnErrorAboveZeroAndACostThatThereIs) {
  PlanOptions none = one_pixel();
  none.error_px = 0.0;
  EXPECT_THROW(plans_of(Table().table(), none), std::invalid_argument);
  none = one_pixel();
  none.cost = 99;
  EXPECT_THROW(plans_of(Table().table(), none), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::audit::plan
