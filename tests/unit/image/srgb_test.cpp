#include "image/srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumb::image {
namespace {

TEST(Srgb, GivesTheStandardsOwnValues) {
  EXPECT_EQ(srgb_to_linear(0.0), 0.0);
  EXPECT_EQ(srgb_to_linear(1.0), 1.0);
  EXPECT_DOUBLE_EQ(srgb_to_linear(0.04045), 0.04045 / 12.92);
  // ((0.5 + 0.055) / 1.055)^2.4 by the C library; both are good to 1e-15.
  EXPECT_NEAR(srgb_to_linear(0.5), std::pow(0.555 / 1.055, 2.4), 2e-15);
}

TEST(Srgb, ReturnsEveryCodeFromItsOwnLight) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(linear_to_srgb8(srgb8_to_linear(static_cast<std::uint8_t>(code))), code);
  }
}

// Linear 0.5 is 1.055 * 0.5^(1/2.4) - 0.055 = 0.73536, times 255 = 187.5 and a little: 188.
TEST(Srgb, EncodesHandComputedLight) {
  EXPECT_EQ(linear_to_srgb8(0.5f), 188);
  EXPECT_EQ(linear_to_srgb8(0.2140f), 127);  // 0.21404 is the light of 127.5
  EXPECT_EQ(linear_to_srgb8(0.2141f), 128);
  EXPECT_EQ(linear_to_srgb8(1.0f / 12.92f / 255.0f), 1);
  EXPECT_EQ(linear_to_srgb8(0.49f / 12.92f / 255.0f), 0);
}

TEST(Srgb, ClampsWhatIsNoLightOfAScreen) {
  EXPECT_EQ(linear_to_srgb8(-1.0f), 0);
  EXPECT_EQ(linear_to_srgb8(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(linear_to_srgb8(7.0f), 255);
  EXPECT_EQ(linear_to_srgb8(std::numeric_limits<float>::infinity()), 255);
}

TEST(Srgb, NeverFallsWhenTheLightRises) {
  for (int k = 1; k <= 100000; ++k) {
    EXPECT_LE(linear_to_srgb8(static_cast<float>(k - 1) * 1e-5f),
              linear_to_srgb8(static_cast<float>(k) * 1e-5f));
  }
}

}  // namespace
}  // namespace plumb::image
