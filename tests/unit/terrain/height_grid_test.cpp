#include "terrain/height_grid.h"

#include <gtest/gtest.h>

#include <bit>
#include <stdexcept>

namespace plumb::terrain {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Grid<std::uint16_t> all_codes() {
  Grid<std::uint16_t> codes(256, 256);
  for (int k = 0; k < 65536; ++k) codes(k % 256, k / 256) = static_cast<std::uint16_t>(k);
  return codes;
}

HeightGrid two_codes_and_a_void() {
  Grid<std::uint16_t> codes(3, 1);
  codes.values() = {5, 9, 7};
  return {std::move(codes), {.void_code = 9}};
}

TEST(HeightGrid, GivesEveryCodeTheFloatOfItsStoredValue) {
  for (const HeightCoding& coding :
       {HeightCoding{}, HeightCoding{-32768}, HeightCoding{0, 0.1}, HeightCoding{-32768, 0.1},
        HeightCoding{-32768, 0.3048, -1234.567}, HeightCoding{0, 1e-9, 8000.0}}) {
    const HeightGrid heights(all_codes(), coding);
    const Grid<float> floats = heights.to_floats();
    std::vector<float> buffer;
    for (int j = 0; j < 256; ++j) {
      const auto row = heights.row(j, buffer);
      for (int i = 0; i < 256; ++i) {
        const double stored = coding.first + 256 * j + i;
        const auto expected = std::bit_cast<std::uint32_t>(
            static_cast<float>(stored * coding.scale + coding.offset_m));
        ASSERT_EQ(std::bit_cast<std::uint32_t>(heights(i, j)), expected);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(row[static_cast<std::size_t>(i)]), expected);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(floats(i, j)), expected);
        ASSERT_FALSE(heights.is_void(i, j));
      }
    }
  }
}

TEST(HeightGrid, HoldsTwoBytesAHeightOfCodesAndFourOfFloats) {
  const HeightGrid coded(all_codes(), {}), floats(coded.to_floats());
  EXPECT_EQ(coded.bytes(), 2 * 65536);
  EXPECT_EQ(floats.bytes(), 4 * 65536);
  EXPECT_TRUE(coded == floats);
}

TEST(HeightGrid, HasNoHeightForTheCodeOfAVoid) {
  const HeightGrid heights = two_codes_and_a_void();
  EXPECT_EQ(heights(0, 0), 5.0f);
  EXPECT_EQ(heights(2, 0), 7.0f);
  EXPECT_TRUE(heights.is_void(1, 0));
  EXPECT_TRUE(std::isnan(heights(1, 0)));
  EXPECT_TRUE(std::isnan(heights.to_floats()(1, 0)));
  EXPECT_FALSE(heights == heights);  // a void equals nothing, as NaN does
}

TEST(HeightGrid, CopiesSamplesWhateverTheyAreKeptAs) {
  HeightGrid coded = two_codes_and_a_void();
  coded.copy(2, 0, 1, 0);
  EXPECT_TRUE(coded.is_coded());
  EXPECT_EQ(coded(1, 0), 7.0f);
  HeightGrid floats = two_codes_and_a_void().to_floats();
  floats.copy(2, 0, 1, 0);
  EXPECT_TRUE(floats == coded);
}

TEST(HeightGrid, GivesUpItsCodesToBeWrittenTo) {
  HeightGrid heights = two_codes_and_a_void();
  heights.floats()(0, 0) = 0.125f;
  EXPECT_FALSE(heights.is_coded());
  EXPECT_EQ(heights.as_codes(), nullptr);
  EXPECT_EQ(heights(0, 0), 0.125f);
  EXPECT_TRUE(heights.is_void(1, 0));
  EXPECT_EQ(heights(2, 0), 7.0f);
  EXPECT_EQ(heights.columns(), 3);
  EXPECT_EQ(heights.bytes(), 12);
}

TEST(HeightGrid, OfFloatsKeepsThem) {
  Grid<float> grid(2, 1, 0.5f);
  grid(1, 0) = kNaN;
  const HeightGrid heights(grid);
  EXPECT_EQ(heights(0, 0), 0.5f);
  EXPECT_TRUE(heights.is_void(1, 0));
  EXPECT_FALSE(heights == HeightGrid(Grid<float>(1, 2)));
  EXPECT_TRUE(HeightGrid() == HeightGrid());
  EXPECT_TRUE(HeightGrid().empty());
}

TEST(HeightGrid, RefusesACodingThatIsNotOrderedOrNotFinite) {
  for (const HeightCoding& coding :
       {HeightCoding{0, 0.0}, HeightCoding{0, -1.0}, HeightCoding{0, 1e38},
        HeightCoding{0, 1.0, std::numeric_limits<double>::infinity()}, HeightCoding{0, kNaN}}) {
    EXPECT_THROW(HeightGrid(Grid<std::uint16_t>(1, 1), coding), std::invalid_argument);
  }
}

}  // namespace
}  // namespace plumb::terrain
