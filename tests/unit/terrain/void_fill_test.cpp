#include "terrain/void_fill.h"

#include <gtest/gtest.h>

namespace plumb::terrain {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

Heightfield field_of(int columns, int rows, const std::vector<float>& heights) {
  Heightfield field;
  field.heights_m = Grid<float>(columns, rows);
  field.heights_m.floats().values() = heights;
  return field;
}

TEST(VoidFill, TakesTheNearestSample) {
  Heightfield field = field_of(4, 1, {1, kVoid, kVoid, 2});
  EXPECT_EQ(fill_voids(field), 2);
  EXPECT_EQ(field.heights_m.floats().values(), (std::vector<float>{1, 1, 2, 2}));
}

TEST(VoidFill, MeasuresInMetres) {
  // Two columns of 1 m are nearer than one row of 3 m.
  Heightfield field = field_of(3, 2, {kVoid, kVoid, 7, 8, kVoid, kVoid});
  field.dx_m = 1.0;
  field.dy_m = 3.0;
  fill_voids(field);
  EXPECT_EQ(field.heights_m(0, 0), 7.0f);
  field = field_of(3, 2, {kVoid, kVoid, 7, 8, kVoid, kVoid});
  fill_voids(field);
  EXPECT_EQ(field.heights_m(0, 0), 8.0f);
}

TEST(VoidFill, OfEquallyFarSamplesTheLowerColumnThenTheLowerRowWins) {
  Heightfield field = field_of(3, 1, {1, kVoid, 2});
  fill_voids(field);
  EXPECT_EQ(field.heights_m(1, 0), 1.0f);
  field = field_of(1, 3, {1, kVoid, 2});
  fill_voids(field);
  EXPECT_EQ(field.heights_m(0, 1), 1.0f);
  field = field_of(3, 3, {kVoid, 4, kVoid, 3, kVoid, 5, kVoid, 6, kVoid});
  fill_voids(field);
  EXPECT_EQ(field.heights_m(1, 1), 3.0f);
}

TEST(VoidFill, LeavesWhatNeedsNoneOrHasNone) {
  Heightfield field = field_of(2, 1, {1, 2});
  EXPECT_EQ(fill_voids(field), 0);
  EXPECT_EQ(field.heights_m.floats().values(), (std::vector<float>{1, 2}));
  field = field_of(2, 1, {kVoid, kVoid});
  EXPECT_EQ(fill_voids(field), 2);
  EXPECT_TRUE(field.is_void(0, 0) && field.is_void(1, 0));
}

}  // namespace
}  // namespace plumb::terrain
