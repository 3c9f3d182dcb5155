#include "report/heat_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumb::report {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// CIE L* of a display colour.
double lightness(Rgb c) {
  const double y = 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
  return y <= 216.0 / 24389.0 ? y * 24389.0 / 27.0 : 116.0 * std::cbrt(y) - 16.0;
}

std::string labels(const std::vector<Tick>& ticks) {
  std::string text;
  for (const Tick& tick : ticks) text += (text.empty() ? "" : " ") + tick.label;
  return text;
}

TEST(HeatScale, PlacesValuesLinearly) {
  const HeatScale scale{1.0, 5.0, false, {}};
  EXPECT_EQ(scale_position(scale, 1.0), 0.0);
  EXPECT_EQ(scale_position(scale, 2.0), 0.25);
  EXPECT_EQ(scale_position(scale, 5.0), 1.0);
  EXPECT_EQ(scale_position(scale, -3.0), 0.0);
  EXPECT_EQ(scale_position(scale, 7.0), 1.0);
}

TEST(HeatScale, PlacesValuesByTheirLogarithm) {
  const HeatScale scale{0.01, 100.0, true, {}};
  // A few units in the last place of four logarithms of at most 5: far below 1e-14.
  EXPECT_NEAR(scale_position(scale, 0.1), 0.25, 1e-14);
  EXPECT_NEAR(scale_position(scale, 1.0), 0.5, 1e-14);
  EXPECT_EQ(scale_position(scale, 0.0), 0.0);
}

TEST(HeatScale, GrowsLighterAllTheWay) {
  double before = -1.0;
  for (int i = 0; i <= 24; ++i) {  // steps wide enough for a byte's rounding not to matter
    const double here = lightness(scale_colour(i / 24.0));
    EXPECT_GT(here, before) << "at " << i << "/24";
    before = here;
  }
  EXPECT_LT(lightness(scale_colour(0.0)), 10.0);
  EXPECT_GT(before, 90.0);
}

TEST(HeatScale, NeverShowsAValueInAColourThatMeansSomethingElse) {
  for (int i = 0; i <= 10000; ++i) {
    const Rgb colour = scale_colour(i / 10000.0);
    EXPECT_NE(colour, kNoValueColour);
    EXPECT_NE(colour, kOverLimitColour);
    EXPECT_NE(colour, kInfiniteColour);
  }
}

TEST(HeatScale, GivesMissingInfiniteAndExcessiveValuesColoursOfTheirOwn) {
  const HeatScale scale{0.0, 2.0, false, 1.0};
  EXPECT_EQ(heat_colour(scale, kNaN), kNoValueColour);
  EXPECT_EQ(heat_colour(scale, kInfinity), kInfiniteColour);
  EXPECT_EQ(heat_colour(scale, std::nextafter(1.0, 2.0)), kOverLimitColour);
  EXPECT_EQ(heat_colour(scale, 1.0), scale_colour(0.5));
  EXPECT_EQ(heat_colour(scale, 0.0), scale_colour(0.0));
}

TEST(HeatScale, PutsTicksAtRoundValues) {
  EXPECT_EQ(labels(scale_ticks({0.0, 1.0, false, {}}, 6)), "0 0.2 0.4 0.6 0.8 1");
  EXPECT_EQ(labels(scale_ticks({0.0, 1.0, false, {}}, 5)), "0 0.5 1");
  EXPECT_EQ(labels(scale_ticks({0.0, 8.775, false, {}}, 6)), "0 2 4 6 8");
  EXPECT_EQ(labels(scale_ticks({0.0, 4000.0, false, {}}, 3)), "0 2000 4000");
  EXPECT_EQ(labels(scale_ticks({0.001, 1.0, true, {}}, 4)), "0.001 0.01 0.1 1");
  EXPECT_EQ(labels(scale_ticks({0.1, 10.0, true, {}}, 9)), "0.1 0.2 0.5 1 2 5 10");
}

TEST(HeatScale, NeverGivesMoreTicksThanAskedFor) {
  for (int most = 2; most < 12; ++most) {
    for (const double high : {1e-9, 0.03, 0.7, 1.0, 8.775, 99.0, 123456.0}) {
      EXPECT_LE(scale_ticks({0.0, high, false, {}}, most).size(), static_cast<std::size_t>(most));
      EXPECT_LE(scale_ticks({high / 1e5, high, true, {}}, most).size(),
                static_cast<std::size_t>(most));
    }
  }
}

TEST(HeatScale, RefusesEmptyScales) {
  EXPECT_THROW(scale_ticks({1.0, 1.0, false, {}}, 4), std::invalid_argument);
  EXPECT_THROW(scale_ticks({0.0, 1.0, true, {}}, 4), std::invalid_argument);
  EXPECT_THROW(scale_ticks({0.0, 1.0, false, {}}, 1), std::invalid_argument);
}

TEST(HeatScale, CountsWhatALegendNames) {
  const std::vector<double> values{0.5, 3.0, kNaN, kInfinity, 2.0, kNaN, 1.0};
  const HeatSummary summary = summarise(values, 1.0);
  EXPECT_EQ(summary.largest_finite, 3.0);
  EXPECT_EQ(summary.finite, 4u);
  EXPECT_EQ(summary.over_limit, 2u);
  EXPECT_EQ(summary.infinite, 1u);
  EXPECT_EQ(summary.no_value, 2u);
}

}  // namespace
}  // namespace plumb::report
