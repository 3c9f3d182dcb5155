// The pair whose answers are published and that the authors' own program was run on.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "compare/flip.h"
#include "compare/flip_pool.h"
#include "image/image_files.h"

namespace plumb::compare {
namespace {

namespace fs = std::filesystem;
const fs::path kPair = PLUMB_SOURCE_DIR "/../shared/data/flip";

struct Picture {
  int width, height;
  std::vector<float> channel[3];
  ColourPlanes planes() const { return {width, height, channel[0], channel[1], channel[2]}; }
};

Picture srgb_of(const fs::path& path) {
  const image::Rgb8Image file = image::read_png(path);
  Picture picture{file.width_px, file.height_px, {}};
  for (std::size_t k = 0; k < file.rgb.size(); ++k)
    picture.channel[k % 3].push_back(static_cast<float>(file.rgb[k]) / 255.0f);
  return picture;
}

TEST(FlipPair, HasTheAnswersOfTheAuthorsProgramAndThePublishedOnes) {
  if (!fs::exists(kPair / "tree-ref.png")) GTEST_SKIP() << "no pair in " << kPair;
  const Picture reference = srgb_of(kPair / "tree-ref.png"),
                test = srgb_of(kPair / "tree-test.png");
  const FlipMap map = flip_ldr(reference.planes(), test.planes());
  ASSERT_EQ(map.width_px, 640);
  ASSERT_EQ(map.height_px, 960);
  const FlipPooled pooled = pool_flip(map.error);
  std::printf("mean %.7f quartiles %.7f %.7f %.7f least %.7f largest %.7f\n", pooled.mean,
              pooled.first_quartile, pooled.median, pooled.third_quartile, pooled.least,
              pooled.largest);
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

}  // namespace
}  // namespace plumb::compare
