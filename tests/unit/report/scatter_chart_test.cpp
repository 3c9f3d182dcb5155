#include "report/scatter_chart.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumb::report {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Axes run over 0.1 .. 100 from 84 to 616 and from 412 up to 48: three decades of 177.33 and of
// 121.33 pixels.
TEST(ScatterChart, PutsPointsWhereTheirDecadesAre) {
  ScatterChart chart;
  chart.title = "a < b";
  chart.diagonal = true;
  chart.points = {{0.1, 100.0, "first"}, {1.0, 10.0, "second"}};
  const std::string svg = to_svg(chart);
  EXPECT_TRUE(contains(svg, "<circle cx=\"84.0\" cy=\"48.0\" r=\"4\"><title>first</title>")) << svg;
  EXPECT_TRUE(contains(svg, "<circle cx=\"261.3\" cy=\"169.3\" r=\"4\"><title>second</title>"));
  EXPECT_TRUE(contains(svg, "a &lt; b"));
  EXPECT_TRUE(contains(svg, ">0.1</text>") && contains(svg, ">100</text>"));
  EXPECT_TRUE(contains(svg, "class=\"same\""));
  EXPECT_EQ(to_svg(chart), svg);
}

TEST(ScatterChart, HasAxesWithoutPointsAndRefusesWhatHasNoLogarithm) {
  EXPECT_TRUE(contains(to_svg({}), "</svg>"));
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    ScatterChart chart;
    chart.points = {{1.0, bad, ""}};
    EXPECT_THROW(to_svg(chart), std::invalid_argument) << bad;
  }
}

}  // namespace
}  // namespace plumb::report
