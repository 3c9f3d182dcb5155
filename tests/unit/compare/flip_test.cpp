#include "compare/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "compare/flip_pool.h"
#include "core/instruction_set.h"
#include "core/parallel.h"
#include "support/flip_pictures.h"

namespace plumb::compare {
namespace {

using testing::FlipPicture;
using testing::patchy_picture;

std::vector<float> errors(const FlipPicture& a, const FlipPicture& b,
                          double density = kFlipPixelsPerDegree) {
  return flip_ldr(a.planes(), b.planes(), {density}).error;
}

void expect_everywhere(const std::vector<float>& map, double expected, double tolerance) {
  for (const float error : map) ASSERT_NEAR(error, expected, tolerance);
}

TEST(Flip, IsZeroForEqualPictures) {
  const FlipPicture picture = patchy_picture(37, 23, 1);
  EXPECT_EQ(errors(picture, picture), std::vector<float>(37 * 23, 0.0f));
}

// L* is 100 against 0: 100^0.7 = 25.1189 stands above the knee, 0.4 * 41.2760 = 16.5104, so that
// the error is 0.95 + 0.05 * (25.1189 - 16.5104) / (41.2760 - 16.5104) = 0.967380. No edge, no
// point.
TEST(Flip, KnowsBlackFromWhite) {
  expect_everywhere(errors({21, 17, glm::dvec3(0.0)}, {21, 17, glm::dvec3(1.0)}), 0.967380, 2e-6);
}

TEST(Flip, IsOneFromGreenToBlue) {
  expect_everywhere(errors({21, 17, {0, 1, 0}}, {21, 17, {0, 0, 1}}), 1.0, 1e-6);
}

TEST(Flip, IsTheSameEitherWay) {
  const FlipPicture a = patchy_picture(41, 29, 2), b = patchy_picture(41, 29, 3);
  EXPECT_EQ(errors(a, b), errors(b, a));
}

TEST(Flip, CutsWhatIsDarkerThanBlackAndBrighterThanWhite) {
  const FlipPicture a(9, 8, [](int x, int y) { return glm::dvec3(x - 3, y - 3, x * y); });
  const FlipPicture cut(
      9, 8, [](int x, int y) { return glm::clamp(glm::dvec3(x - 3, y - 3, x * y), 0.0, 1.0); });
  const FlipPicture b = patchy_picture(9, 8, 4);
  EXPECT_EQ(errors(a, b), errors(cut, b));
}

// In float32 a detector's answer is good to about 4e-8, of whose difference the error takes the
// root: 2e-4 in the exponent where there is next to no feature, and c^(1 - f) moves by |c ln c| <=
// 0.37 times that. Powers add 2e-6.
constexpr double kAnyPixel = 8e-5;

void expect_as_slow(const FlipPicture& a, const FlipPicture& b, double density) {
  const auto linear = [](const glm::dvec3& srgb) { return testing::slow_linear(srgb); };
  const std::vector<double> slow =
      testing::slow_flip(a.slow().map(linear), b.slow().map(linear), density);
  const std::vector<float> map = errors(a, b, density);
  ASSERT_EQ(map.size(), slow.size());
  double sum = 0.0;
  for (std::size_t k = 0; k < map.size(); ++k) {
    ASSERT_NEAR(map[k], slow[k], kAnyPixel) << k << " of " << a.width << " x " << a.height;
    sum += map[k] - slow[k];
  }
  EXPECT_NEAR(sum / static_cast<double>(map.size()), 0.0, 5e-6);
}

TEST(Flip, AgreesWithTheSlowComputation) {
  expect_as_slow(patchy_picture(45, 33, 5), patchy_picture(45, 33, 6), kFlipPixelsPerDegree);
  expect_as_slow(patchy_picture(45, 33, 7), patchy_picture(45, 33, 7, 0.1), kFlipPixelsPerDegree);
  expect_as_slow(patchy_picture(45, 33, 8), patchy_picture(45, 33, 9), 20.0);
}

TEST(Flip, TakesPicturesThatAreSmallerThanItsFilters) {
  const int sizes[][2] = {{1, 1}, {1, 2}, {2, 1}, {1, 40}, {40, 1}, {3, 5}, {16, 4}, {17, 9}};
  for (const auto& [width, height] : sizes)
    expect_as_slow(patchy_picture(width, height, 10), patchy_picture(width, height, 11),
                   kFlipPixelsPerDegree);
}

TEST(Flip, TakesAnyDensity) {
  for (const double density : {1.0, 3.0, 150.0})
    expect_as_slow(patchy_picture(19, 11, 12), patchy_picture(19, 11, 13), density);
}

TEST(Flip, HasTheSameBitsWithEveryInstructionSetAndOnAnyNumberOfThreads) {
  for (const int width : {1, 15, 16, 33, 130}) {
    const FlipPicture a = patchy_picture(width, 50, 14), b = patchy_picture(width, 50, 15);
    std::vector<float> first;
    for (const InstructionSet set : available_instruction_sets()) {
      const ForcedInstructionSet forced(set);
      for (const int threads : {1, 7}) {
        const ThreadLimit limit(threads);
        const std::vector<float> map = errors(a, b);
        if (first.empty()) first = map;
        EXPECT_EQ(map, first) << name_of(set) << ' ' << threads << ' ' << width;
      }
    }
  }
}

TEST(Flip, GrowsWithTheDistanceAndVanishesFarAway) {
  // A chequered board against even grey of the same luminance: seen from near it differs.
  const FlipPicture board(40, 40, [](int x, int y) { return glm::dvec3((x + y) % 2); });
  const FlipPicture even(40, 40, glm::dvec3(0.735357));  // sRGB of linear 0.5
  const double near = pool_flip(errors(board, even, 10.0)).mean;
  const double far = pool_flip(errors(board, even, 200.0)).mean;
  EXPECT_GT(near, 0.3);
  EXPECT_LT(far, 0.5 * near);
}

TEST(Flip, NamesWhatIsWrong) {
  const FlipPicture good = patchy_picture(4, 3, 16), other = patchy_picture(3, 4, 16);
  EXPECT_THROW(errors(good, other), std::invalid_argument);
  EXPECT_THROW(flip_ldr({}, {}), std::invalid_argument);
  EXPECT_THROW(errors(good, good, 0.0), std::invalid_argument);
  ColourPlanes lacking = good.planes();
  lacking.b = lacking.b.first(11);
  EXPECT_THROW(flip_ldr(good.planes(), lacking), std::invalid_argument);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    FlipPicture spoilt = good;
    spoilt.channel[1][7] = bad;
    try {
      errors(good, spoilt);
      FAIL() << "accepted " << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("channel g at (3, 1)"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace plumb::compare
