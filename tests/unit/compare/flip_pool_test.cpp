#include "compare/flip_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "support/flip_pictures.h"

namespace plumb::compare {
namespace {

// Halves and quarters, so that sums are exact: 0.125, 0.125, 0.25, 0.5, 1 sum to 2.
const std::vector<float> kErrors{0.5f, 0.125f, 1.0f, 0.25f, 0.125f};

TEST(FlipPool, WeighsPercentilesByTheErrorItself) {
  // Sums from the smallest upwards: 0.125, 0.25, 0.5, 1, 2. More than a quarter of 2 is reached
  // with 0.5, more than a half with 1.
  EXPECT_EQ(weighted_percentile(kErrors, 0.0), 0.125);
  EXPECT_EQ(weighted_percentile(kErrors, 0.124), 0.125);
  EXPECT_EQ(weighted_percentile(kErrors, 0.125), 0.25);
  EXPECT_EQ(weighted_percentile(kErrors, 0.25), 0.5);
  EXPECT_EQ(weighted_percentile(kErrors, 0.499), 0.5);
  EXPECT_EQ(weighted_percentile(kErrors, 0.5), 1.0);
  EXPECT_EQ(weighted_percentile(kErrors, 1.0), 1.0);
}

// The two lesser ones are close neighbours: 0.5 and 0.5 + 1/512, and 1 - 1/512. A quarter of 2 is
// what the first holds, not more.
TEST(FlipPool, TellsCloseNeighboursApart) {
  const std::vector<float> errors{0.998046875f, 0.501953125f, 0.5f};
  EXPECT_EQ(weighted_percentile(errors, 0.249), 0.5);
  EXPECT_EQ(weighted_percentile(errors, 0.25), 0.501953125);
  EXPECT_EQ(weighted_percentile(errors, 0.5), 0.501953125);
  EXPECT_EQ(weighted_percentile(errors, 0.501), 0.998046875);
}

TEST(FlipPool, GivesTheOtherNumbersUnweighted) {
  const FlipPooled pooled = pool_flip(kErrors);
  EXPECT_EQ(pooled.pixels, 5);
  EXPECT_EQ(pooled.mean, 0.4);
  EXPECT_EQ(pooled.least, 0.125);
  EXPECT_EQ(pooled.largest, 1.0);
  EXPECT_EQ(pooled.first_quartile, 0.5);
  EXPECT_EQ(pooled.median, 1.0);
  EXPECT_EQ(pooled.third_quartile, 1.0);
  EXPECT_EQ(pooled.histogram[12], 2);
  EXPECT_EQ(pooled.histogram[25], 1);
  EXPECT_EQ(pooled.histogram[50], 1);
  EXPECT_EQ(pooled.histogram[99], 1);
}

TEST(FlipPool, LeavesOutWhatDoesNotCount) {
  const FlipPooled pooled = pool_flip(kErrors, std::vector<std::uint8_t>{1, 0, 0, 2, 1});
  EXPECT_EQ(pooled.pixels, 3);
  EXPECT_EQ(pooled.mean, 0.875 / 3.0);
  EXPECT_EQ(pooled.largest, 0.5);
  EXPECT_EQ(pooled.histogram[99], 0);
}

TEST(FlipPool, IsZeroWhereNothingCountsOrNothingDiffers) {
  for (const FlipPooled& pooled :
       {pool_flip({}), pool_flip(kErrors, std::vector<std::uint8_t>(5, 0)),
        pool_flip(std::vector<float>(7, 0.0f))}) {
    EXPECT_EQ(pooled.mean, 0.0);
    EXPECT_EQ(pooled.median, 0.0);
    EXPECT_EQ(pooled.largest, 0.0);
  }
  EXPECT_EQ(pool_flip(std::vector<float>(7, -0.0f)).histogram[0], 7);
}

TEST(FlipPool, FindsThePercentilesThatSortingFinds) {
  testing::FlipNumbers numbers(4);
  std::vector<float> errors;
  for (int k = 0; k < 20000; ++k) {
    const double x = numbers.next();
    errors.push_back(static_cast<float>(k % 3 == 0 ? 0.0 : x * x * x));
  }
  std::vector<float> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  double sum = 0.0;
  for (const float error : sorted) sum += error;
  for (int percent = 1; percent < 100; ++percent) {
    double below = 0.0;
    std::size_t k = 0;
    // The two sums may differ in their last bits, which moves the answer by one error at most.
    while ((below += sorted[k]) <= percent / 100.0 * sum) ++k;
    const double found = weighted_percentile(errors, percent / 100.0);
    EXPECT_GE(found, sorted[k - 1]) << percent;
    EXPECT_LE(found, sorted[k + 1]) << percent;
  }
}

TEST(FlipPool, RefusesWhatIsNoError) {
  EXPECT_THROW(pool_flip(std::vector<float>{0.5f, 1.5f}), std::invalid_argument);
  EXPECT_THROW(pool_flip(std::vector<float>{-0.5f}), std::invalid_argument);
  EXPECT_THROW(pool_flip(std::vector<float>{std::numeric_limits<float>::quiet_NaN()}),
               std::invalid_argument);
  EXPECT_THROW(pool_flip(kErrors, std::vector<std::uint8_t>(4, 1)), std::invalid_argument);
  EXPECT_THROW(weighted_percentile(kErrors, 1.5), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::compare
