#include "compare/plane_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace plumb::compare {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(PlaneErrors, AreThoseComputedByHand) {
  const std::vector<float> reference{0.0f, 0.5f, 1.0f, 0.25f}, candidate{0.0f, 0.75f, 0.5f, 0.25f};
  const PlaneErrors errors = plane_errors(reference, candidate);
  EXPECT_EQ(errors.compared, 4);
  EXPECT_EQ(errors.differing, 2);
  EXPECT_EQ(errors.largest, 0.5);
  EXPECT_EQ(errors.worst, 2u);
  EXPECT_EQ(errors.mean, 0.1875);
  EXPECT_EQ(errors.root_mean_square, std::sqrt(0.3125 / 4.0));
  // 10 log10(1 / 0.078125) = 11.0721, by hand from log10(12.8).
  ASSERT_TRUE(errors.psnr_db());
  EXPECT_NEAR(*errors.psnr_db(), 10.0 * std::log10(12.8), 1e-12);
  EXPECT_FALSE(errors.equal());
}

TEST(PlaneErrors, EqualPlanesHaveNoRatio) {
  const std::vector<float> plane{0.1f, -3.0f, kInf, kNaN};
  const PlaneErrors errors = plane_errors(plane, plane);
  EXPECT_TRUE(errors.equal());
  EXPECT_EQ(errors.compared, 2);
  EXPECT_EQ(errors.alike, 2);
  EXPECT_FALSE(errors.psnr_db());
}

TEST(PlaneErrors, NumbersThatAreNoneAreCountedAndNeverAveraged) {
  const std::vector<float> reference{kNaN, kNaN, kInf, kInf, 1.0f, 2.0f};
  const std::vector<float> candidate{kNaN, 1.0f, -kInf, kInf, kInf, 2.5f};
  const PlaneErrors errors = plane_errors(reference, candidate);
  EXPECT_EQ(errors.alike, 2);
  EXPECT_EQ(errors.unlike, 3);
  EXPECT_EQ(errors.first_unlike, 1u);
  EXPECT_EQ(errors.compared, 1);
  EXPECT_EQ(errors.mean, 0.5);
  EXPECT_FALSE(errors.equal());
}

TEST(PlaneErrors, LooksAtTheMaskAlone) {
  const std::vector<float> reference{0.0f, 0.0f, kNaN}, candidate{1.0f, 0.5f, 1.0f};
  const PlaneErrors errors = plane_errors(reference, candidate, std::vector<std::uint8_t>{0, 1, 0});
  EXPECT_EQ(errors.compared, 1);
  EXPECT_EQ(errors.largest, 0.5);
  EXPECT_EQ(errors.unlike, 0);
}

TEST(PlaneErrors, SameBitsOnAnyNumberOfThreads) {
  std::vector<float> reference(300'000), candidate(300'000);
  for (std::size_t k = 0; k < reference.size(); ++k) {
    reference[k] = static_cast<float>(k % 977) / 977.0f;
    candidate[k] = static_cast<float>((k * 7 + 3) % 991) / 991.0f;
  }
  candidate[200'001] = candidate[250'000] = 7.0f;
  reference[200'001] = reference[250'000] = 0.0f;
  const PlaneErrors all = plane_errors(reference, candidate);
  EXPECT_EQ(all.worst, 200'001u);
  for (const int threads : {1, 3, 7}) {
    const ThreadLimit limit(threads);
    const PlaneErrors again = plane_errors(reference, candidate);
    EXPECT_EQ(again.mean, all.mean);
    EXPECT_EQ(again.root_mean_square, all.root_mean_square);
    EXPECT_EQ(again.worst, all.worst);
  }
}

TEST(PlaneErrors, RefusesUnlikeSizes) {
  EXPECT_THROW(plane_errors(std::vector<float>(3), std::vector<float>(4)), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::compare
