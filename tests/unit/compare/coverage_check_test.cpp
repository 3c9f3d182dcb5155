#include "compare/coverage_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/random_scene.h"

namespace plumb::compare {
namespace {

using test_support::Random;
using Coverage = std::vector<std::uint8_t>;

// Pixel by pixel.
CoverageErrors slow(const Coverage& reference, const Coverage& candidate, int width, int height,
                    int band) {
  CoverageErrors errors;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      bool terrain = true, sky = true;
      for (int j = std::max(0, y - band); j <= std::min(height - 1, y + band); ++j) {
        for (int i = std::max(0, x - band); i <= std::min(width - 1, x + band); ++i) {
          const bool here = reference[static_cast<std::size_t>(j * width + i)] != 0;
          terrain = terrain && here;
          sky = sky && !here;
        }
      }
      const auto pixel = static_cast<std::size_t>(y * width + x);
      errors.must_be_terrain += terrain;
      errors.must_be_sky += sky;
      errors.undecided += !terrain && !sky;
      const bool hole = terrain && candidate[pixel] == 0, over = sky && candidate[pixel] != 0;
      errors.holes += hole;
      errors.overshoot += over;
      if (hole || over) errors.wrong.push_back(pixel);
    }
  }
  return errors;
}

TEST(CoverageCheck, IsThatOfALoopOverAllNeighbours) {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    const int width = random.integer(1, 30), height = random.integer(1, 30);
    const int band = random.integer(0, 4);
    const double share = random.uniform(0.0, 1.0);
    Coverage reference(static_cast<std::size_t>(width * height)), candidate = reference;
    for (auto& pixel : reference) pixel = random.chance(share < 0.5 ? 0.02 : 0.97);
    for (auto& pixel : candidate) pixel = random.chance(0.5);
    const CoverageErrors found = check_coverage(reference, candidate, width, height, band);
    const CoverageErrors expected = slow(reference, candidate, width, height, band);
    ASSERT_EQ(found.must_be_terrain, expected.must_be_terrain) << round;
    ASSERT_EQ(found.must_be_sky, expected.must_be_sky);
    ASSERT_EQ(found.undecided, expected.undecided);
    ASSERT_EQ(found.holes, expected.holes);
    ASSERT_EQ(found.overshoot, expected.overshoot);
    ASSERT_EQ(found.wrong, expected.wrong);
  }
}

TEST(CoverageCheck, FindsEveryPixelOfACrackAndForgivesAnOutline) {
  const int width = 100, height = 60;
  Coverage reference(6000), candidate(6000);
  for (int k = 0; k < 6000; ++k) {
    reference[static_cast<std::size_t>(k)] = k / width > 30;
    candidate[static_cast<std::size_t>(k)] = k / width > 31;  // a pixel lower: within the band
  }
  EXPECT_TRUE(check_coverage(reference, candidate, width, height).wrong.empty());
  for (int x = 20; x < 80; ++x) candidate[static_cast<std::size_t>(45 * width + x)] = 0;
  EXPECT_EQ(check_coverage(reference, candidate, width, height).holes, 60);
}

TEST(CoverageCheck, ReadsDepthBeforeAlpha) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  image::PlaneImage picture{3, 1, image::Encoding::Linear, 0, {}, {}};
  EXPECT_FALSE(shown_terrain(picture));
  picture.planes.push_back({"A", {0.4f, 0.5f, 1.0f}});
  EXPECT_EQ(*shown_terrain(picture), (Coverage{0, 1, 1}));
  picture.planes.push_back({"Z", {kInf, 5.0f, std::numeric_limits<float>::quiet_NaN()}});
  EXPECT_EQ(*shown_terrain(picture), (Coverage{0, 1, 0}));
}

TEST(CoverageCheck, KnowsWhatStandsForSky) {
  const auto depths = [](std::vector<float> z) {
    return image::PlaneImage{4, 1, image::Encoding::Linear, 0, {{"Z", std::move(z)}}, {}};
  };
  // No ground: not finite, zero and less, 1e9 and more.
  EXPECT_EQ(*shown_terrain(depths({5.0f, 0.0f, -3.0f, 1e10f})), (Coverage{1, 0, 0, 0}));
  // Window depth that was cleared to one; ground alone.
  EXPECT_EQ(*shown_terrain(depths({0.5f, 0.9f, 1.0f, 0.7f})), (Coverage{1, 1, 0, 1}));
  EXPECT_EQ(*shown_terrain(depths({0.5f, 0.9f, 1.5f, 0.7f})), (Coverage{1, 1, 1, 1}));
  // The rule is that of both pictures: a crack in one alone is sky.
  const image::PlaneImage whole = depths({5.0f, 5.0f, 5.0f, 5.0f}),
                          cracked = depths({5.0f, 1e10f, 5.0f, 5.0f});
  EXPECT_EQ(shown_terrain(cracked, *sky_rule(whole, cracked)), (Coverage{1, 0, 1, 1}));
  // Alpha says more than depth that has no sky.
  image::PlaneImage both = whole;
  both.planes.push_back({"A", {1.0f, 0.2f, 1.0f, 1.0f}});
  EXPECT_EQ(*shown_terrain(both), (Coverage{1, 0, 1, 1}));
}

}  // namespace
}  // namespace plumb::compare
