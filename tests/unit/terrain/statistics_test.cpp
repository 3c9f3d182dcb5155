#include "terrain/statistics.h"

#include <gtest/gtest.h>

#include <numeric>

#include "terrain/generators.h"

namespace plumb::terrain {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

TEST(Statistics, OfATiltedPlane) {
  // Slopes of 3 in 4 and 0: every cell at atan(0.75) = 36.87 degrees, the eighth bin.
  const TerrainStatistics s =
      statistics_of(generate("generate:tilted-plane?size=5x3&spacing=4&slope_x=0.75&slope_y=0"));
  EXPECT_EQ(s.columns, 5);
  EXPECT_EQ(s.rows, 3);
  EXPECT_EQ(s.width_m, 16.0);
  EXPECT_EQ(s.height_m, 8.0);
  EXPECT_EQ(s.heights, 15);
  EXPECT_EQ(s.voids, 0);
  EXPECT_EQ(s.cells, 8);
  EXPECT_EQ(s.slope_histogram[7], 8);
  EXPECT_EQ(std::accumulate(s.slope_histogram.begin(), s.slope_histogram.end(), 0), 8);
  // 36.8698976... degrees; atan is good to 1e-15 relative.
  EXPECT_NEAR(s.rms_slope_deg, 36.86989764584402, 1e-12);
  EXPECT_NEAR(s.largest_slope_deg, 36.86989764584402, 1e-12);
  EXPECT_EQ(s.lowest.height_m, 0.0);
  EXPECT_EQ(s.highest.height_m, 12.0);
  EXPECT_EQ(s.highest.i, 4);
  EXPECT_EQ(s.highest.j, 0);  // of equal ones the southernmost
  EXPECT_EQ(s.mean_m, 6.0);
}

TEST(Statistics, LevelGroundFillsTheFirstBin) {
  const TerrainStatistics s = statistics_of(generate("generate:plane?size=3"));
  EXPECT_EQ(s.slope_histogram[0], 4);
  EXPECT_EQ(s.largest_slope_deg, 0.0);
  EXPECT_EQ(s.steepest_step.rise_m, 0.0);
}

TEST(Statistics, FindTheSteepestStepAndItsSide) {
  Heightfield field;
  field.dx_m = 10.0;
  field.dy_m = 5.0;
  field.heights_m = Grid<float>(3, 3, 0.0f);
  field.heights_m.floats()(2, 1) = 4.0f;
  field.heights_m.floats()(0, 2) = -5.0f;
  const TerrainStatistics s = statistics_of(field);
  EXPECT_EQ(s.steepest_step.rise_m, 5.0);
  EXPECT_EQ(s.steepest_step.i, 0);
  EXPECT_EQ(s.steepest_step.j, 1);
  EXPECT_TRUE(s.steepest_step.northwards);
  EXPECT_NEAR(s.steepest_step.slope_deg, 45.0, 1e-12);
  EXPECT_EQ(s.lowest.height_m, -5.0);
  EXPECT_EQ(s.lowest.j, 2);
}

TEST(Statistics, VoidsHaveNoHeightNoStepAndNoCell) {
  Heightfield field;
  field.heights_m = Grid<float>(3, 2, 1.0f);
  field.heights_m.floats()(2, 1) = kVoid;
  const TerrainStatistics s = statistics_of(field);
  EXPECT_EQ(s.voids, 1);
  EXPECT_EQ(s.heights, 5);
  EXPECT_EQ(s.cells, 1);
  EXPECT_EQ(s.mean_m, 1.0);
  EXPECT_EQ(s.steepest_step.rise_m, 0.0);
}

TEST(Statistics, NothingButVoids) {
  Heightfield field;
  field.heights_m = Grid<float>(4, 4, kVoid);
  const TerrainStatistics s = statistics_of(field);
  EXPECT_EQ(s.voids, 16);
  EXPECT_EQ(s.heights, 0);
  EXPECT_EQ(s.cells, 0);
  EXPECT_EQ(s.mean_m, 0.0);
}

TEST(Statistics, OfOneSample) {
  const TerrainStatistics s = statistics_of(generate("generate:plane?size=1&height=5"));
  EXPECT_EQ(s.lowest.height_m, 5.0);
  EXPECT_EQ(s.cells, 0);
}

}  // namespace
}  // namespace plumb::terrain
