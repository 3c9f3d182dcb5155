#include "raster/shading/preview.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "raster/shading/shade.h"

namespace plumb::raster {
namespace {

terrain::Heightfield field_of(int columns, int rows, double dx_m = 1.0, double dy_m = 1.0) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(columns, rows, 0.0f);
  field.dx_m = dx_m;
  field.dy_m = dy_m;
  return field;
}

TEST(Preview, HasSquarePixelsOnTheGroundAndNoMoreThanAsked) {
  const auto size = [](const terrain::Heightfield& field, int max_px) {
    const auto image = shaded_preview(field, max_px);
    return std::pair(image.width_px, image.height_px);
  };
  EXPECT_EQ(size(field_of(200, 100), 50), std::pair(50, 25));
  EXPECT_EQ(size(field_of(20, 10), 50), std::pair(20, 10));  // no finer than the samples
  EXPECT_EQ(size(field_of(100, 100, 1.0, 2.0), 100), std::pair(50, 100));
  EXPECT_EQ(size(field_of(1, 1), 9), std::pair(1, 1));
  EXPECT_EQ(size(field_of(1000, 1), 10), std::pair(10, 1));
}

// Level ground is lit by 0.35 + 0.65 sin 45 degrees and has the lowest tint.
TEST(Preview, OfLevelGroundHasOneColour) {
  const auto image = shaded_preview(field_of(4, 4), 4);
  const double light = 0.35 + 0.65 * std::sqrt(0.5);
  for (const float green : image.g) {
    EXPECT_FLOAT_EQ(green, static_cast<float>(hypsometric_tint(0.0).y * light));
  }
}

TEST(Preview, ShowsVoidsInAColourOfTheirOwnAndNorthUp) {
  terrain::Heightfield field = field_of(2, 3);
  field.heights_m.floats()(1, 2) = NAN;  // north-east
  const auto image = shaded_preview(field, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 2; ++x) {
      const bool is_void = image.r[image.index(x, y)] == static_cast<float>(kVoidColour.x);
      EXPECT_EQ(is_void, x == 1 && y == 0);
    }
  }
}

TEST(Preview, OfVoidsAloneIsVoid) {
  terrain::Heightfield field = field_of(2, 2);
  for (float& height : field.heights_m.floats().values()) height = NAN;
  for (const float red : shaded_preview(field, 2).r) {
    EXPECT_EQ(red, static_cast<float>(kVoidColour.x));
  }
}

// A ridge from south-west to north-east: its north-western side faces the light.
TEST(Preview, LightsTheSideTowardsNorthWest) {
  terrain::Heightfield field = field_of(21, 21);
  for (int j = 0; j < 21; ++j) {
    for (int i = 0; i < 21; ++i)
      field.heights_m.floats()(i, j) = -std::abs(static_cast<float>(i - j));
  }
  const auto image = shaded_preview(field, 21);
  EXPECT_GT(image.g[image.index(5, 5)], 1.2f * image.g[image.index(15, 15)]);  // same height
}

TEST(Preview, IsTheSameOnAnyNumberOfThreads) {
  terrain::Heightfield field = field_of(301, 203);
  unsigned state = 1;
  for (float& height : field.heights_m.floats().values()) {
    state = state * 1664525u + 1013904223u;
    height = state % 97 == 0 ? NAN : static_cast<float>(state >> 20);
  }
  const auto first = shaded_preview(field, 100);
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(shaded_preview(field, 100), first);
  }
}

TEST(Preview, RefusesNoPixels) {
  EXPECT_THROW(shaded_preview(field_of(2, 2), 0), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::raster
