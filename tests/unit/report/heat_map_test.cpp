#include "report/heat_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "report/bitmap_font.h"

namespace plumb::report {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// True if the word stands somewhere in the picture, dot by dot, in any one colour on another.
bool shows(const RgbImage& image, const std::string& word, int scale = 1) {
  RgbImage wanted(text_width_px(word, scale), kGlyphRows * scale);
  draw_text(wanted, 0, 0, word, {1, 1, 1}, scale);
  const Rgb ink{24, 24, 28};
  for (int y = 0; y + wanted.height <= image.height; ++y) {
    for (int x = 0; x + wanted.width <= image.width; ++x) {
      bool same = true;
      for (int v = 0; same && v < wanted.height; ++v) {
        for (int u = 0; same && u < wanted.width; ++u)
          same = (image.at(x + u, y + v) == ink) == (wanted.at(u, v) == Rgb{1, 1, 1});
      }
      if (same) return true;
    }
  }
  return false;
}

int count(const RgbImage& image, Rgb colour) {
  int found = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) found += image.at(x, y) == colour;
  }
  return found;
}

std::vector<double> ramp(int width, int height, double high) {
  std::vector<double> values;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) values.push_back(high * x / (width - 1));
  }
  return values;
}

TEST(HeatMap, ColoursEachPixelByItsValue) {
  const std::vector<double> values{0.0, 0.5, 1.0, 1.5, kNaN, kInfinity};
  const RgbImage image = heat_picture(3, 2, values, {.limit = 1.0});
  EXPECT_EQ(image.at(0, 0), scale_colour(0.0));
  EXPECT_EQ(image.at(1, 0), scale_colour(0.5));
  EXPECT_EQ(image.at(2, 0), scale_colour(1.0));
  EXPECT_EQ(image.at(0, 1), kOverLimitColour);
  EXPECT_EQ(image.at(1, 1), kNoValueColour);
  EXPECT_EQ(image.at(2, 1), kInfiniteColour);
}

TEST(HeatMap, EndsItsScaleAtTheLimitOrElseAtTheLargestValue) {
  const std::vector<double> values{0.25, 4.0};
  EXPECT_EQ(heat_scale(values, {}).high, 4.0);
  EXPECT_EQ(heat_scale(values, {.limit = 1.0}).high, 1.0);
  EXPECT_EQ(heat_scale(values, {.high = 2.0, .limit = 1.0}).high, 2.0);
  EXPECT_EQ(heat_scale(values, {.limit = kInfinity}).high, 4.0);
  EXPECT_EQ(heat_scale(values, {.logarithmic = true}).low, 0.004);
}

TEST(HeatMap, HasAScaleForATerrainWithoutError) {
  const std::vector<double> zeros(4, 0.0);
  EXPECT_EQ(heat_scale(zeros, {}).high, 1.0);
  EXPECT_EQ(heat_picture(2, 2, zeros).at(1, 1), scale_colour(0.0));
  EXPECT_GT(heat_scale(zeros, {.logarithmic = true}).low, 0.0);
  EXPECT_EQ(heat_map(2, 2, zeros, {.limit = 0.0}).at(0, 0), scale_colour(0.0));
}

TEST(HeatMap, PutsTheLegendBelowThePicture) {
  const std::vector<double> values = ramp(360, 8, 2.0);
  const HeatMapOptions options{.title = "pixel error", .limit = 1.0};
  const RgbImage map = heat_map(360, 8, values, options);
  const RgbImage picture = heat_picture(360, 8, values, options);
  const RgbImage legend = heat_legend(360, values, options);
  EXPECT_EQ(map.width, 360);
  EXPECT_EQ(map.height, 8 + legend.height);
  EXPECT_TRUE(std::equal(picture.rgb.begin(), picture.rgb.end(), map.rgb.begin()));
}

TEST(HeatMap, WritesTitleMaximumTicksUnitAndCountsIntoTheLegend) {
  std::vector<double> values = ramp(360, 8, 2.0);
  values[0] = kNaN;
  values[1] = kInfinity;
  const RgbImage legend = heat_legend(360, values, {.title = "pixel error", .limit = 1.0});
  EXPECT_TRUE(shows(legend, "pixel error"));
  EXPECT_TRUE(shows(legend, "max 2 px"));
  EXPECT_TRUE(shows(legend, "0.4 px"));
  EXPECT_TRUE(shows(legend, "over 1 px: 1440"));  // half of 360 x 8, no value being exactly 1
  EXPECT_TRUE(shows(legend, "infinite: 1"));
  EXPECT_TRUE(shows(legend, "no value: 1"));
  EXPECT_FALSE(shows(legend, "max 3 px"));
}

TEST(HeatMap, ShowsTheWholeScaleInTheLegend) {
  const RgbImage legend = heat_legend(360, ramp(360, 2, 1.0));
  EXPECT_EQ(count(legend, scale_colour(0.0)), 8);  // one column of the bar at either end
  EXPECT_EQ(count(legend, scale_colour(1.0)), 8);
}

TEST(HeatMap, FitsALegendUnderNarrowAndWidePictures) {
  for (const int width : {1, 8, 33, 120, 640, 1920, 3840}) {
    const std::vector<double> values(static_cast<std::size_t>(width) * 2, 0.5);
    const RgbImage map = heat_map(width, 2, values, {.title = "pixel error", .limit = 1.0});
    EXPECT_EQ(map.rgb.size(), 3u * static_cast<unsigned>(width * map.height)) << width;
  }
  const std::vector<double> wide(1920, 0.5);
  EXPECT_TRUE(shows(heat_legend(1920, wide, {.title = "pixel error"}), "pixel error", 4));
}

TEST(HeatMap, RefusesSizesThatDoNotFit) {
  const std::vector<double> values(6, 0.0);
  EXPECT_THROW(heat_picture(2, 2, values), std::invalid_argument);
  EXPECT_THROW(heat_picture(0, 6, values), std::invalid_argument);
  EXPECT_THROW(heat_legend(0, values), std::invalid_argument);
  EXPECT_THROW(heat_scale(values, {.low = -1.0}), std::invalid_argument);
  EXPECT_THROW(heat_scale(values, {.low = 2.0, .high = 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::report
