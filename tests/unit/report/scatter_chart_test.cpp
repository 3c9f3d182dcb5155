#include "report/scatter_chart.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "support/small_xml.h"

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

int times(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

// Linear axes: x to 20 over 532 pixels from 84, y to 3 over 364 pixels from 412 up, shifted by the
// legend's one row of 20.
ScatterChart two_series() {
  ScatterChart chart;
  chart.x_axis = chart.y_axis = AxisKind::Linear;
  chart.series = {{"fine", {{20.0, 3.0, "last"}, {10.0, 0.0, "first"}}, true},
                  {"coarse & <b>", {{5.0, 1.5, "\"a\" < b"}}, false}};
  return chart;
}

TEST(ScatterChart, GivesEachSeriesAColourAndAMarkerAndTheLegendItsName) {
  const std::string svg = to_svg(two_series());
  EXPECT_TRUE(contains(svg, "width=\"640\" height=\"500\"")) << svg;
  EXPECT_TRUE(contains(svg, ".series-0 path{fill:#0072b2}"));
  EXPECT_TRUE(contains(svg, ".series-1 path{fill:#d55e00}"));
  EXPECT_EQ(times(svg, "<path d=\"M-4,0a"), 3);        // two points and the legend
  EXPECT_EQ(times(svg, "<path d=\"M-3.5,-3.5h7"), 2);  // one and the legend
  EXPECT_EQ(times(svg, "<path "), 5);
  EXPECT_EQ(times(svg, "<circle"), 0);
  EXPECT_TRUE(contains(svg, "transform=\"translate(616.0 68.0)\"><title>last</title>"));
  EXPECT_TRUE(contains(svg, "transform=\"translate(217.0 250.0)\">"));  // a quarter and a half
  EXPECT_TRUE(contains(svg, ">fine</text>"));
}

// A line for the joined series, from its least x, and one in its legend.
TEST(ScatterChart, JoinsASeriesInOrderOfX) {
  const std::string svg = to_svg(two_series());
  EXPECT_TRUE(contains(svg, "<polyline points=\"350.0,432.0 616.0,68.0\"/>")) << svg;
  EXPECT_EQ(times(svg, "<polyline"), 2);
}

TEST(ScatterChart, EscapesItsTexts) {
  const std::string svg = to_svg(two_series());
  EXPECT_EQ(testing::xml_fault(svg), "");
  EXPECT_TRUE(contains(svg, ">coarse &amp; &lt;b&gt;</text>")) << svg;
  EXPECT_FALSE(contains(svg, "\" < b"));
}

// As tall as without one: nothing is said of it but its markers.
TEST(ScatterChart, HasNoLegendForASeriesWithoutAName) {
  ScatterChart chart = two_series();
  chart.series = {{"", {{1.0, 1.0, ""}}, false}};
  const std::string svg = to_svg(chart);
  EXPECT_TRUE(contains(svg, "height=\"480\""));
  EXPECT_EQ(times(svg, "<path "), 1);
}

// Half of an axis to 4, which a limit of 4 asks for.
TEST(ScatterChart, MarksItsLimitAndHasItOnTheAxis) {
  ScatterChart chart;
  chart.x_axis = chart.y_axis = AxisKind::Linear;
  chart.points = {{1.0, 2.0, ""}};
  chart.limit = 4.0;
  chart.limit_label = "< allowed";
  const std::string svg = to_svg(chart);
  EXPECT_TRUE(contains(svg, "<line class=\"same\" x1=\"84.0\" y1=\"48.0\" x2=\"616.0\""));
  EXPECT_TRUE(contains(svg, "cy=\"230.0\""));
  EXPECT_TRUE(contains(svg, "<text x=\"90.0\" y=\"61.0\">&lt; allowed</text>"));  // below: 48 + 13
}

// At 2 of an axis to 4, 182 pixels below its end: the text stands above the mark.
TEST(ScatterChart, NamesALimitAboveItsMark) {
  ScatterChart chart;
  chart.x_axis = chart.y_axis = AxisKind::Linear;
  chart.points = {{1.0, 4.0, ""}};
  chart.limit = 2.0;
  chart.limit_label = "allowed";
  EXPECT_TRUE(contains(to_svg(chart), "<text x=\"90.0\" y=\"221.0\">allowed</text>"));  // 230 - 9
}

// 20 + 200 + 28 pixels, then 44 + 200 + 64 with texts above and below: and one row of the legend.
TEST(ScatterChart, StandsInPanelsUnderOneLegend) {
  std::array<ScatterChart, 2> panels{two_series(), two_series()};
  panels[1].title = "second";
  panels[1].x_label = "x";
  const std::string svg = svg_of_panels(panels);
  EXPECT_TRUE(contains(svg, "width=\"640\" height=\"576\"")) << svg;
  EXPECT_EQ(testing::xml_fault(svg), "");
  EXPECT_EQ(times(svg, ">fine</text>"), 1);
  EXPECT_EQ(times(svg, "<title>last</title>"), 2);
  EXPECT_TRUE(contains(svg, "translate(616.0 40.0)"));
  EXPECT_TRUE(contains(svg, "translate(616.0 312.0)"));  // 20 + 248 + 44
}

TEST(ScatterChart, RefusesWhatItCannotShow) {
  ScatterChart chart = two_series();
  chart.series.resize(ScatterChart::kMostSeries + 1);
  EXPECT_THROW(to_svg(chart), std::invalid_argument);
  chart = two_series();
  chart.x_axis = AxisKind::Log10;
  chart.diagonal = true;
  EXPECT_THROW(to_svg(chart), std::invalid_argument);
  chart = two_series();
  chart.y_axis = AxisKind::Log10;  // one y is zero
  EXPECT_THROW(to_svg(chart), std::invalid_argument);
  chart = {};
  chart.limit = 0.0;
  EXPECT_THROW(to_svg(chart), std::invalid_argument);
  std::array<ScatterChart, 2> panels{two_series(), two_series()};
  panels[1].series[0].name = "finer";
  EXPECT_THROW(svg_of_panels(panels), std::invalid_argument);
  EXPECT_THROW(svg_of_panels({}), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::report
