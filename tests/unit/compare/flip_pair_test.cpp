// The pair whose answers are published and that the authors' own program was run on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "compare/flip.h"
#include "compare/flip_pool.h"
#include "image/image_files.h"
#include "support/flip_pictures.h"

namespace plumb::compare {
namespace {

namespace fs = std::filesystem;
const fs::path kPair = PLUMB_SOURCE_DIR "/../shared/data/flip";

testing::FlipPicture srgb_of(const fs::path& path) {
  const image::Rgb8Image file = image::read_png(path);
  testing::FlipPicture picture(file.width_px, file.height_px);
  for (std::size_t k = 0; k < file.rgb.size(); ++k)
    picture.channel[k % 3][k / 3] = static_cast<float>(file.rgb[k]) / 255.0f;
  return picture;
}

TEST(FlipPair, HasTheAnswersOfTheAuthorsProgramAndThePublishedOnes) {
  if (!fs::exists(kPair / "tree-ref.png")) GTEST_SKIP() << "no pair in " << kPair;
  const testing::FlipPicture reference = srgb_of(kPair / "tree-ref.png");
  const testing::FlipPicture test = srgb_of(kPair / "tree-test.png");
  const FlipMap map = flip_ldr(reference.planes(), test.planes());
  ASSERT_EQ(map.width_px, 640);
  ASSERT_EQ(map.height_px, 960);
  const FlipPooled pooled = pool_flip(map.error);
  // The program prints six digits and works in float32 itself: 1e-5 is what it was measured to.
  EXPECT_NEAR(pooled.mean, 0.133276, 1e-5);
  // Published with the tolerance of 1e-4.
  EXPECT_NEAR(pooled.mean, 0.133285, 1e-4);
  EXPECT_NEAR(pooled.first_quartile, 0.184924, 1e-4);
  EXPECT_NEAR(pooled.median, 0.333241, 1e-4);
  EXPECT_NEAR(pooled.third_quartile, 0.503441, 1e-4);
  EXPECT_NEAR(pooled.largest, 0.983044, 1e-4);
  EXPECT_EQ(pooled.least, 0.0);
}

// What the same pair has in double precision: its mean tells what float32 costs.
TEST(LongFlipPair, HasTheMeanOfTheSlowComputation) {
  if (!fs::exists(kPair / "tree-ref.png")) GTEST_SKIP() << "no pair in " << kPair;
  const testing::FlipPicture reference = srgb_of(kPair / "tree-ref.png");
  const testing::FlipPicture test = srgb_of(kPair / "tree-test.png");
  const auto linear = [](const glm::dvec3& srgb) { return testing::slow_linear(srgb); };
  const std::vector<double> slow = testing::slow_flip(
      reference.slow().map(linear), test.slow().map(linear), kFlipPixelsPerDegree);
  const FlipMap map = flip_ldr(reference.planes(), test.planes());
  double sum = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < slow.size(); ++k) {
    sum += slow[k];
    largest = std::max(largest, std::abs(map.error[k] - slow[k]));
  }
  const double mean = sum / static_cast<double>(slow.size());
  RecordProperty("mean", fmt::format("{:.8f}", mean));
  RecordProperty("our_mean", fmt::format("{:.8f}", pool_flip(map.error).mean));
  RecordProperty("largest_difference", fmt::format("{:.8f}", largest));
  // As flip_test.cpp derives for a single pixel; the mean of their rounding is far smaller.
  EXPECT_LT(largest, 8e-5);
  EXPECT_NEAR(pool_flip(map.error).mean, mean, 1e-6);
}

}  // namespace
}  // namespace plumb::compare
