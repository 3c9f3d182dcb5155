#include "compare/flip_filters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "compare/flip.h"
#include "core/reproducible_math.h"
#include "support/slow_flip.h"

namespace plumb::compare {
namespace {

double whole_sum(const std::vector<double>& half) {
  return half[0] + 2.0 * std::accumulate(half.begin() + 1, half.end(), 0.0);
}

// 3 * 0.045016 degrees are 9.05 of the usual pixels, 3 * 0.041 degrees 8.24.
TEST(FlipFilters, ReachThreeStandardDeviationsRoundedUp) {
  EXPECT_NEAR(kFlipPixelsPerDegree, 67.0206, 5e-5);
  const FlipFilters filters = flip_filters(kFlipPixelsPerDegree);
  EXPECT_EQ(filters.reach, 10);
  EXPECT_GT(filters.half[kBlueYellowA][10], 0.0);
  for (const FlipFilter filter : {kGauss, kEdge, kPoint}) {
    EXPECT_NE(filters.half[filter][9], 0.0);
    EXPECT_EQ(filters.half[filter][10], 0.0);
  }
  EXPECT_EQ(flip_filters(2.0 * kFlipPixelsPerDegree).reach, 19);
}

TEST(FlipFilters, SumToOne) {
  for (const double density : {1.0, 7.0, kFlipPixelsPerDegree, 300.0}) {
    const FlipFilters filters = flip_filters(density);
    for (const FlipFilter filter : {kLuminance, kRedGreen, kGauss})
      EXPECT_NEAR(whole_sum(filters.half[filter]), 1.0, 1e-14) << density;
    const double a = whole_sum(filters.half[kBlueYellowA]);
    const double b = whole_sum(filters.half[kBlueYellowB]);
    EXPECT_NEAR(a * a + b * b, 1.0, 1e-14) << density;
  }
}

TEST(FlipFilters, DetectorsSumToOneAndMinusOne) {
  for (const double density : {1.0, 12.0, kFlipPixelsPerDegree, 300.0}) {
    const FlipFilters filters = flip_filters(density);
    const std::vector<double>&edge = filters.half[kEdge], &point = filters.half[kPoint];
    EXPECT_EQ(edge[0], 0.0);
    EXPECT_NEAR(std::accumulate(edge.begin(), edge.end(), 0.0), 1.0, 1e-14);
    double above = 0.0, below = 0.0;
    for (std::size_t k = 0; k < point.size(); ++k)
      (point[k] > 0.0 ? above : below) += (k == 0 ? 1.0 : 2.0) * point[k];
    EXPECT_NEAR(above, 1.0, 1e-14);
    EXPECT_NEAR(below, -1.0, 1e-14);
    EXPECT_LT(point[0], 0.0);
  }
}

// exp(-pi^2 / (d^2 0.0047)) is 1/e where d = pi / sqrt(0.0047), and for red against green likewise.
TEST(FlipFilters, FallAsTheEyesSensitivityDoes) {
  const FlipFilters luminance = flip_filters(kPi / std::sqrt(0.0047));
  EXPECT_NEAR(luminance.half[kLuminance][1] / luminance.half[kLuminance][0], std::exp(-1.0), 1e-14);
  EXPECT_NEAR(luminance.half[kLuminance][2] / luminance.half[kLuminance][0], std::exp(-4.0), 1e-14);
  const FlipFilters red_green = flip_filters(kPi / std::sqrt(0.0053));
  EXPECT_NEAR(red_green.half[kRedGreen][1] / red_green.half[kRedGreen][0], std::exp(-1.0), 1e-14);
}

TEST(FlipFilters, AreTheWholeFiltersOfThePaperWhenMultiplied) {
  for (const double density : {20.0, kFlipPixelsPerDegree}) {
    const FlipFilters filters = flip_filters(density);
    const testing::SlowFilters slow = testing::slow_filters(density);
    const auto& half = filters.half;
    for (int j = 0; j <= filters.reach; ++j) {
      for (int i = 0; i <= filters.reach; ++i) {
        const auto of = [&](const testing::SlowKernel& kernel) {
          const int r = kernel.radius;
          if (i > r || j > r) return 0.0;
          return kernel.weights[static_cast<std::size_t>((j + r) * (2 * r + 1) + i + r)];
        };
        EXPECT_NEAR(half[kLuminance][i] * half[kLuminance][j], of(slow.colour[0]), 1e-14);
        EXPECT_NEAR(half[kRedGreen][i] * half[kRedGreen][j], of(slow.colour[1]), 1e-14);
        EXPECT_NEAR(half[kBlueYellowA][i] * half[kBlueYellowA][j] +
                        half[kBlueYellowB][i] * half[kBlueYellowB][j],
                    of(slow.colour[2]), 1e-14);
        EXPECT_NEAR(-half[kEdge][i] * half[kGauss][j], of(slow.detectors[0]), 1e-14);
        EXPECT_NEAR(half[kGauss][i] * half[kPoint][j], of(slow.detectors[3]), 1e-14);
      }
    }
  }
}

TEST(FlipFilters, StandInEveryLane) {
  const FlipFilters filters = flip_filters(30.0);
  for (int k = 0; k <= filters.reach; ++k) {
    for (int f = 0; f < kFlipFilters; ++f) {
      for (int lane = 0; lane < kFlipLanes; ++lane)
        EXPECT_EQ(filters.taps().weights[(k * kFlipFilters + f) * kFlipLanes + lane],
                  static_cast<float>(filters.half[f][k]));
    }
  }
}

TEST(FlipFilters, NeedADensity) {
  for (const double density : {0.0, 0.99, -1.0, 1000.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(flip_filters(density), std::invalid_argument);
}

// Green and blue have L*a*b* (87.735, -86.183, 83.179) and (32.297, 79.188, -107.860).
TEST(FlipConstants, KnowTheLargestDifference) {
  const double a = -86.183 * 0.87735 - 79.188 * 0.32297;
  const double b = 83.179 * 0.87735 + 107.860 * 0.32297;
  const double largest = std::pow(87.735 - 32.297 + std::hypot(a, b), 0.7);
  EXPECT_NEAR(flip_largest_difference(), largest, 1e-3);  // three digits went in
  EXPECT_NEAR(flip_largest_difference(), 41.276, 1e-3);
}

TEST(FlipConstants, TakeWhiteToWhiteAndBack) {
  const FlipConstants& c = flip_constants();
  for (int row = 0; row < 3; ++row) {
    const auto sum = [row](const float* m) { return m[3 * row] + m[3 * row + 1] + m[3 * row + 2]; };
    EXPECT_NEAR(sum(c.to_xyz), 1.0, 1e-7);
    EXPECT_NEAR(sum(c.to_opponent), row == 0 ? 1.0 : 0.0, 1e-7);
    EXPECT_NEAR(c.from_opponent[3 * row], 1.0, 1e-6);
  }
  // The luminance of the primaries.
  EXPECT_NEAR(c.to_opponent[0], 0.2126, 1e-4);
  EXPECT_NEAR(c.to_opponent[1], 0.7152, 1e-4);
  EXPECT_NEAR(c.to_opponent[2], 0.0722, 1e-4);
}

}  // namespace
}  // namespace plumb::compare
