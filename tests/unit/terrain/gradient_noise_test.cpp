#include "terrain/gradient_noise_3d.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/drawn_stacks.h"

namespace plumb::terrain {
namespace {

double drawn(test_support::Draws& draws, int reach) {
  return draws.whole(-1000 * reach, 1000 * reach) / 1000.0;
}

TEST(GradientNoise3D, IsZeroAtLatticePoints) {
  for (const std::int64_t k : {-7, -1, 0, 3}) {
    const auto at = static_cast<double>(k);
    EXPECT_EQ(gradient_noise(at, 2.0, -at, 5), 0.0);
  }
  EXPECT_NE(gradient_noise(0.5, 2.0, 0.0, 5), 0.0);
}

TEST(GradientNoise3D, LiesWithinOne) {
  test_support::Draws draws(3);
  double highest = 0.0;
  for (int round = 0; round < 300000; ++round) {
    const double value = gradient_noise(drawn(draws, 50), drawn(draws, 50), drawn(draws, 50), 1);
    EXPECT_LE(std::abs(value), 1.0);
    highest = std::max(highest, std::abs(value));
  }
  EXPECT_GT(highest, 0.8);
}

TEST(GradientNoise3D, OfAnotherSeedOrAxisIsAnother) {
  EXPECT_NE(gradient_noise(0.3, 0.4, 0.45, 1), gradient_noise(0.3, 0.4, 0.45, 2));
  EXPECT_NE(gradient_noise(0.3, 0.4, 0.45, 1), gradient_noise(0.45, 0.3, 0.4, 1));
}

TEST(NoiseColumn, IsTheNoiseAboveItsPlace) {
  test_support::Draws draws(4);
  NoiseColumn column;
  for (int round = 0; round < 300; ++round) {
    const double x = drawn(draws, 20), y = drawn(draws, 20);
    column.stand_at(x, y, -3.5, 6.0, 9);
    for (double z = -3.5; z <= 6.0; z += 0.125)
      ASSERT_EQ(column.at(z), gradient_noise(x, y, z, 9)) << x << " " << y << " " << z;
  }
}

// Values below 1 are rounded to about 2^-52: over 2^-10 a slope is wrong by less than 1e-11.
TEST(NoiseColumn, ChangesByNoMoreThanItsSteepestSlope) {
  test_support::Draws draws(5);
  NoiseColumn column;
  double closest = 0.0;
  for (int round = 0; round < 2000; ++round) {
    column.stand_at(drawn(draws, 20), drawn(draws, 20), 0.0, 1.0, 9);
    for (double z = 0.0; z < 1.0; z += 0x1p-10) {
      const double slope = std::abs(column.at(z + 0x1p-10) - column.at(z)) * 0x1p10;
      ASSERT_LE(slope, column.steepest() + 1e-11);
      closest = std::max(closest, slope / column.steepest());
    }
  }
  EXPECT_GT(closest, 0.8);  // it is no bound that anything would keep
}

}  // namespace
}  // namespace plumb::terrain
