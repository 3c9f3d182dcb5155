#include "report/histogram_chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "support/small_xml.h"

namespace plumb::report {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

int times(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

// Four bins of one from 0 to 4; the last one has its upper end.
TEST(Histogram, SortsValuesIntoBinsOfOneWidth) {
  const std::vector<float> values{0.5f, 0.9f, 1.0f, 2.5f, 3.0f, 4.0f};
  const Histogram histogram = histogram_of(values, 4);
  EXPECT_EQ(histogram.high, 4.0);
  EXPECT_EQ(histogram.counts, (std::vector<std::int64_t>{2, 1, 1, 2}));
}

TEST(Histogram, CountsEveryValueOnce) {
  const std::vector<float> values{0.0f, 0.0f, -1.0f, kInfinite, kNone, kNone, 2.0f, 1.0f};
  const Histogram histogram = histogram_of(values, 3);
  EXPECT_EQ(histogram.zero, 3);
  EXPECT_EQ(histogram.infinite, 1);
  EXPECT_EQ(histogram.no_value, 2);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::int64_t{0}), 2);
}

TEST(Histogram, OfZerosEndsAtOne) {
  EXPECT_EQ(histogram_of(std::vector<float>{0.0f, 0.0f}, 2), (Histogram{1.0, {0, 0}, 2, 0, 0}));
}

// The smallest of floats still lies in a bin.
TEST(Histogram, HasNoValueTooSmallForIt) {
  const float least = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(histogram_of(std::vector<float>{least}, 8).counts.back(), 1);
}

TEST(HistogramChart, DrawsABarForEachBinThatHasPixels) {
  const std::string svg = to_svg({"title", "difference", "", {4.0, {100, 0, 1, 7}}, {}});
  EXPECT_EQ(times(svg, "<rect class=\"bar\""), 3);
  EXPECT_EQ(testing::xml_fault(svg), "");
}

// Counts 1 and 10 to 100: two decades over the one of half a pixel to one. The axis runs from
// y = 252 (half) to y = 44 (a hundred), so that one lies at 252 - 208 log(2) / log(200) = 224.8.
TEST(HistogramChart, HasLogarithmicCountsFromHalfAPixel) {
  const std::string svg = to_svg({"t", "x", "", {1.0, {100, 1}}, {}});
  EXPECT_NE(svg.find("y=\"44.0\" width"), std::string::npos) << svg;
  EXPECT_NE(svg.find("y=\"224.8\" width"), std::string::npos) << svg;
}

TEST(HistogramChart, ColoursWhatLiesAboveTheLimit) {
  const std::string svg = to_svg({"t", "x", "px", {4.0, {1, 1, 1, 1}}, 2.0});
  EXPECT_EQ(times(svg, "<rect class=\"over\""), 2);
  EXPECT_EQ(times(svg, "<line class=\"limit\""), 1);
  EXPECT_EQ(times(to_svg({"t", "x", "px", {4.0, {1, 1, 1, 1}}, 5.0}), "class=\"limit\""), 0);
}

TEST(HistogramChart, EscapesItsTexts) {
  const std::string svg = to_svg({"<script>", "a & b", "\"", {1.0, {1}}, {}});
  EXPECT_EQ(testing::xml_fault(svg), "");
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
}

TEST(HistogramChart, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(histogram_of({}, 0), std::invalid_argument);
  EXPECT_THROW(to_svg({"t", "x", "", {1.0, {}}, {}}), std::invalid_argument);
  EXPECT_THROW(to_svg({"t", "x", "", {1.0, {-1}}, {}}), std::invalid_argument);
  EXPECT_THROW(to_svg({"t", "x", "", {0.0, {1}}, {}}), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::report
