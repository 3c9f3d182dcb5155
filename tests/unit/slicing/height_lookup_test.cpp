// Heights as slices look them up, against hand-computed ones.
#include "slicing/height_lookup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/test_terrain.h"

namespace plumb::slicing {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

// Heights row by row from the south, 10 m apart.
Heightfield field_of(int columns, std::initializer_list<float> heights) {
  Heightfield field;
  field.heights_m = Grid<float>(columns, static_cast<int>(heights.size()) / columns);
  const float* next = heights.begin();
  for (int j = 0; j < field.heights_m.rows(); ++j) {
    for (int i = 0; i < columns; ++i) field.heights_m.floats()(i, j) = *next++;
  }
  field.dx_m = field.dy_m = 10.0;
  return field;
}

TEST(HeightLookup, FollowsTheTrianglesTheTextureOrTheNearestSample) {
  const Heightfield field = field_of(2, {0, 4, 8, 100});
  const HeightLookup rising(field, Diagonal::Alternating),
      bilinear(field, Diagonal::Alternating, Interpolation::Bilinear),
      nearest(field, Diagonal::Alternating, Interpolation::Nearest);
  EXPECT_DOUBLE_EQ(bilinear.height_m(5.0, 5.0), 28.0);
  EXPECT_DOUBLE_EQ(bilinear.height_m(2.5, 0.0), 1.0);
  EXPECT_EQ(nearest.height_m(4.0, 6.0), 8.0);
  EXPECT_EQ(nearest.height_m(6.0, 6.0), 100.0);
  const double on_diagonal = rising.height_m(5.0, 5.0);
  EXPECT_TRUE(on_diagonal == 50.0 || on_diagonal == 6.0);  // as the cell's diagonal runs
  EXPECT_TRUE(std::isnan(rising.height_m(-0.1, 5.0)));
  EXPECT_TRUE(std::isnan(rising.height_m(5.0, 10.1)));
  EXPECT_EQ(rising.height_m(10.0, 10.0), 100.0);
}

// 255 m of relief: a step is a metre, and rounding is what remains.
TEST(HeightLookup, OfEightBitsIsOffByHalfAStepAtASampleAndOneBetween) {
  const Heightfield field = field_of(3, {0, 0.4f, 0.6f, 10.2f, 100.49f, 255, 3, 3, 3});
  const HeightLookup alpha(field, Diagonal::Alternating, Interpolation::EightBit);
  EXPECT_DOUBLE_EQ(alpha.height_m(0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(alpha.height_m(10.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(alpha.height_m(20.0, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(alpha.height_m(10.0, 10.0), 100.0);
  EXPECT_DOUBLE_EQ(alpha.height_m(15.0, 10.0), 178.0);  // 177.5 between 100 and 255, rounded up
  EXPECT_DOUBLE_EQ(alpha.reference_m(41.3), 41.0);
  EXPECT_EQ(HeightLookup(field, Diagonal::Alternating).reference_m(41.3), 41.3);
  const Heightfield rough = test_support::rough_terrain(33, 33, 4, 400.0);
  const HeightLookup coarse(rough, Diagonal::Alternating, Interpolation::EightBit),
      exact(rough, Diagonal::Alternating, Interpolation::Bilinear);
  const Box box = terrain::bounds(rough);
  const double step_m = (box.high.z - box.low.z) / 255.0;
  double worst = 0.0;
  for (double x = 0.0; x <= 32.0 * rough.dx_m; x += 1.7) {
    for (double y = 0.0; y <= 32.0 * rough.dy_m; y += 2.3)
      worst = std::max(worst, std::abs(coarse.height_m(x, y) - exact.height_m(x, y)));
  }
  EXPECT_LE(worst, step_m * (1.0 + 1e-9));  // half of a texel's, half of the result's
  EXPECT_GT(worst, 0.5 * step_m);
}

TEST(HeightLookup, MipMappedAveragesWhatAPixelCovers) {
  const Heightfield field = field_of(4, {0, 4, 8, 12, 4, 8, 12, 16, 8, 12, 16, 20, 12, 16, 20, 24});
  const HeightLookup mip(field, Diagonal::Alternating, Interpolation::MipMapped);
  // A plane stays one between the middles of the coarse texels, whatever the level.
  for (const double texels : {0.0, 1.0, 1.5, 2.0}) {
    EXPECT_NEAR(mip.mipmapped_m(15.0, 15.0, texels), 12.0, 1e-12) << texels;
    EXPECT_NEAR(mip.mipmapped_m(10.0, 20.0, texels), 12.0, 1e-12) << texels;
  }
  // Beyond the outermost middles the texture is flat: the corner's 2 x 2 average.
  EXPECT_NEAR(mip.mipmapped_m(0.0, 0.0, 2.0), 4.0, 1e-12);
  EXPECT_NEAR(mip.mipmapped_m(0.0, 0.0, 1.0), 0.0, 1e-12);
  EXPECT_NEAR(mip.mipmapped_m(0.0, 0.0, std::sqrt(2.0)), 2.0, 1e-9);  // half way
  EXPECT_NEAR(mip.mipmapped_m(0.0, 0.0, 1e9), 4.0, 1e-12);            // the last level
  EXPECT_TRUE(std::isnan(mip.mipmapped_m(-1.0, 0.0, 1.0)));
}

TEST(HeightLookup, VoidsStayVoidInEveryKindOfLookup) {
  const Heightfield field =
      field_of(4, {0, 4, 8, 12, 4, kVoid, 12, 16, 8, 12, 16, 20, 12, 16, 20, 24});
  for (const Interpolation kind :
       {Interpolation::Triangulated, Interpolation::Bilinear, Interpolation::Nearest,
        Interpolation::EightBit, Interpolation::MipMapped}) {
    const HeightLookup heights(field, Diagonal::Alternating, kind);
    EXPECT_TRUE(std::isnan(heights.height_m(10.0, 10.0))) << static_cast<int>(kind);
    EXPECT_FALSE(std::isnan(heights.height_m(30.0, 30.0)));
  }
  // The average of the three that there are.
  const HeightLookup mip(field, Diagonal::Alternating, Interpolation::MipMapped);
  EXPECT_NEAR(mip.mipmapped_m(0.0, 0.0, 2.0), 8.0 / 3.0, 1e-6);
}

}  // namespace
}  // namespace plumb::slicing
