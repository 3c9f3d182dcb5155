#include "terrain/sample_decoding.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumb::terrain {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(DecodeSamples, ValuesTooLargeForFloatAreNotFinite) {
  const std::vector<double> stored{1e39, -1e300, std::numeric_limits<float>::max()};
  std::vector<float> heights(3);
  const DecodingTally tally = decode_samples(stored, {}, {}, heights);
  EXPECT_EQ(tally.voids_not_finite, 2);
  EXPECT_TRUE(std::isnan(heights[0]) && std::isnan(heights[1]));
  EXPECT_EQ(heights[2], std::numeric_limits<float>::max());
}

TEST(DecodeSamples, MaskedSamplesAreDeclaredVoids) {
  const std::vector<double> stored{kNaN, 1.0, 2.0};
  const std::vector<std::uint8_t> mask{0, 0, 1};
  std::vector<float> heights(3);
  const DecodingTally tally = decode_samples(stored, mask, {}, heights);
  EXPECT_EQ(tally.voids_declared, 2);
  EXPECT_EQ(tally.voids_not_finite, 0);
  EXPECT_EQ(heights[2], 2.0f);
}

TEST(DecodeColour, GivesTheNearestDoubleOfTheDecimalValue) {
  EXPECT_EQ(decode_colour(Decode::TerrainRgb, 1, 134, 161), 0.1);
  EXPECT_EQ(decode_colour(Decode::TerrainRgb, 2, 29, 116), 3861.2);  // 131072 + 7424 + 116 = 138612
  EXPECT_EQ(decode_colour(Decode::Terrarium, 128, 1, 1), 1.00390625);
  EXPECT_THROW(decode_colour(Decode::Grey, 0, 0, 0), std::invalid_argument);
}

TEST(HeightfieldBuilder, TurnsRowsThatRunSouth) {
  for (const bool south : {true, false}) {
    HeightfieldBuilder builder("a", 2, 3, {}, south);
    const std::vector<double> upper{1, 2, 3, 4}, lower{5, 6};
    builder.add(0, {upper, {}});
    builder.add(2, {lower, {}});
    const Heightfield field = builder.finish();
    EXPECT_EQ(field.heights_m(0, south ? 2 : 0), 1.0f);
    EXPECT_EQ(field.heights_m(1, 1), 4.0f);
    EXPECT_EQ(field.heights_m(1, south ? 0 : 2), 6.0f);
  }
}

TEST(RowsPerChunk, AreWholeBlocksAndAtLeastOneRow) {
  EXPECT_EQ(rows_per_chunk(1 << 30), 1);
  EXPECT_EQ(rows_per_chunk(1 << 30, 256), 1);
  EXPECT_EQ(rows_per_chunk(16384, 512), 512);  // 2^23 samples, 64 MiB
  EXPECT_EQ(rows_per_chunk(16385, 512), 31);
  EXPECT_EQ(rows_per_chunk(1024, 500), 1000);  // 512 rows are 4 MiB of doubles
}

}  // namespace
}  // namespace plumb::terrain
