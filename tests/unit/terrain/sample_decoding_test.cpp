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

Heightfield built(const SampleCoding& coding, const std::vector<double>& stored,
                  const std::vector<std::uint8_t>& mask = {}) {
  HeightfieldBuilder builder("a", 1, static_cast<int>(stored.size()), coding, false);
  for (std::size_t k = 0; k < stored.size(); ++k) {  // a row at a time
    const std::span all(mask);
    builder.add(static_cast<int>(k),
                {std::span(stored).subspan(k, 1), mask.empty() ? all : all.subspan(k, 1)});
  }
  return builder.finish();
}

SampleCoding stored_as(SampleType type) {
  SampleCoding coding;
  coding.stored_as = type;
  return coding;
}
const SampleCoding kInt16 = stored_as(SampleType::Int16);
const SampleCoding kUint16 = stored_as(SampleType::Uint16);

TEST(HeightfieldBuilder, KeepsWholeNumbersOf16BitsAsCodes) {
  const Heightfield signs = built(kInt16, {-32768, 0, 32767});
  EXPECT_TRUE(signs.heights_m.is_coded());
  EXPECT_EQ(signs.heights_m(0, 0), -32768.0f);  // no void among them: no code is kept for it
  EXPECT_EQ(signs.heights_m(0, 2), 32767.0f);
  SampleCoding decimetres = kUint16;
  decimetres.scale = 0.1;
  decimetres.offset_m = -7.0;
  const Heightfield whole = built(decimetres, {0, 1, 65535});
  EXPECT_TRUE(whole.heights_m.is_coded());
  EXPECT_EQ(whole.heights_m(0, 1), static_cast<float>(1 * 0.1 - 7.0));
  EXPECT_EQ(whole.heights_m(0, 2), static_cast<float>(65535 * 0.1 - 7.0));
  EXPECT_FALSE(built({}, {0, 1}).heights_m.is_coded());
}

TEST(HeightfieldBuilder, GivesVoidsTheCodeOfANoDataValue) {
  SampleCoding coding = kInt16;
  coding.no_data = {-9999.0, 12.0};
  const Heightfield field = built(coding, {-9999, -32768, 12, 32767, -9998});
  EXPECT_TRUE(field.heights_m.is_coded());
  EXPECT_TRUE(field.is_void(0, 0) && field.is_void(0, 2));
  EXPECT_EQ(field.heights_m(0, 1), -32768.0f);
  EXPECT_EQ(field.heights_m(0, 3), 32767.0f);
  EXPECT_EQ(field.heights_m(0, 4), -9998.0f);
  EXPECT_EQ(field.provenance.voids_declared, 2);
}

// Masked samples and heights of all codes: in either order, and in one row after many.
TEST(HeightfieldBuilder, GivesUpCodesWhereNoneIsLeftForAVoid) {
  const std::vector<double> stored{3, 65535, 4, 9};
  for (const std::vector<std::uint8_t>& mask :
       {std::vector<std::uint8_t>{0, 1, 1, 1}, std::vector<std::uint8_t>{1, 1, 1, 0}}) {
    const Heightfield field = built(kUint16, stored, mask);
    EXPECT_FALSE(field.heights_m.is_coded());
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(field.is_void(0, k), mask[static_cast<std::size_t>(k)] == 0);
      if (!field.is_void(0, k)) {
        EXPECT_EQ(field.heights_m(0, k), static_cast<float>(stored[static_cast<std::size_t>(k)]));
      }
    }
    EXPECT_EQ(field.provenance.voids_declared, 1);
  }
  const Heightfield fits = built(kUint16, {3, 65534, 4}, {0, 1, 1});
  EXPECT_TRUE(fits.heights_m.is_coded() && fits.is_void(0, 0));
  EXPECT_EQ(fits.heights_m(0, 1), 65534.0f);
}

TEST(HeightfieldBuilder, KeepsFloatsWhereCodesWouldNotBeOrdered) {
  SampleCoding depths = kUint16;
  depths.scale = -1.0;
  const Heightfield field = built(depths, {0, 10});
  EXPECT_FALSE(field.heights_m.is_coded());
  EXPECT_EQ(field.heights_m(0, 1), -10.0f);
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
