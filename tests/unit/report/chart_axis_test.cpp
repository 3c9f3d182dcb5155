#include "report/chart_axis.h"

#include <gtest/gtest.h>

namespace plumb::report {
namespace {

std::string texts(const ChartAxis& axis) {
  std::string all;
  for (int tick = axis.low; tick <= axis.high; ++tick)
    all += (tick > axis.low ? " " : "") + axis.tick_text(tick);
  return all;
}

std::string ticks_of(AxisKind kind, const std::vector<double>& values) {
  return texts(axis_around(kind, values, 0.0, 100.0));
}

TEST(ChartAxis, OfDecadesHasWholeOnes) {
  EXPECT_EQ(ticks_of(AxisKind::Log10, {0.02, 30.0}), "0.01 0.1 1 10 100");
  EXPECT_EQ(ticks_of(AxisKind::Log10, {1000.0}), "1000 10000");
  EXPECT_EQ(ticks_of(AxisKind::Log10, {2e5, 3e6}), "1e5 1e6 1e7");
}

// Twenty views want steps of more than 20 / 6; 0.7 of more than 0.117.
TEST(ChartAxis, OfStepsCountsInOnesTwosAndFives) {
  EXPECT_EQ(ticks_of(AxisKind::Linear, {1.0, 20.0}), "0 5 10 15 20");
  EXPECT_EQ(ticks_of(AxisKind::Linear, {4.0}), "0 1 2 3 4");
  EXPECT_EQ(ticks_of(AxisKind::Linear, {0.7, 0.1}), "0 0.2 0.4 0.6 0.8");
  EXPECT_EQ(ticks_of(AxisKind::Linear, {2.5e6}), "0 500000 1e+06 1.5e+06 2e+06 2.5e+06");
}

TEST(ChartAxis, OfStepsHasZeroOnIt) {
  EXPECT_EQ(ticks_of(AxisKind::Linear, {-3.0, -1.0}), "-3 -2.5 -2 -1.5 -1 -0.5 0");
  EXPECT_EQ(ticks_of(AxisKind::Linear, {-10.0, 25.0}), "-10 0 10 20 30");
}

TEST(ChartAxis, HasOneDecadeOrOneStepWithoutValues) {
  EXPECT_EQ(ticks_of(AxisKind::Log10, {}), "1 10");
  EXPECT_EQ(ticks_of(AxisKind::Linear, {}), "0 1");
  EXPECT_EQ(ticks_of(AxisKind::Linear, {0.0}), "0 1");
}

// From 0 at 300 up to 8 at 100: 25 pixels each. Of decades 1 to 100, ten lies in the middle.
TEST(ChartAxis, PlacesValuesBetweenItsEnds) {
  const ChartAxis steps = axis_around(AxisKind::Linear, {8.0}, 300.0, 100.0);
  EXPECT_EQ(steps.place_px(0.0), 300.0);
  EXPECT_EQ(steps.place_px(3.0), 225.0);
  EXPECT_EQ(steps.tick_px(steps.high), 100.0);
  const ChartAxis decades = axis_around(AxisKind::Log10, {2.0, 90.0}, 0.0, 100.0);
  EXPECT_NEAR(decades.place_px(10.0), 50.0, 1e-9);  // a quotient of two logarithms
}

// The widest and the narrowest spans that doubles have still give a step.
TEST(ChartAxis, EndsForAnySpan) {
  EXPECT_EQ(axis_around(AxisKind::Linear, {-1.7e308, 1.7e308}, 0.0, 1.0).high, 2);
  EXPECT_EQ(axis_around(AxisKind::Linear, {5e-324}, 0.0, 1.0).high, 1);
}

}  // namespace
}  // namespace plumb::report
