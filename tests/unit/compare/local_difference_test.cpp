#include "compare/local_difference.h"

#include <gtest/gtest.h>

#include <array>

#include "core/parallel.h"
#include "support/random_scene.h"

namespace plumb::compare {
namespace {

constexpr int kWidth = 30, kHeight = 20;
using Plane = std::vector<float>;

LocalDifference between(const Plane& a, const Plane& b) {
  const std::array<std::span<const float>, 1> reference{a}, candidate{b};
  return local_difference(reference, candidate, kWidth, kHeight);
}

Plane columns(float left, float right, int edge) {
  Plane plane(kWidth * kHeight);
  for (std::size_t k = 0; k < plane.size(); ++k)
    plane[k] = static_cast<int>(k % kWidth) < edge ? left : right;
  return plane;
}

TEST(LocalDifference, IsThatComputedByHand) {
  const Plane flat(kWidth * kHeight, 0.25f);
  Plane dot = flat;
  const std::size_t pixel = 8 * kWidth + 9;
  dot[pixel] = 0.75f;
  const LocalDifference found = between(flat, dot);
  // In the candidate a quarter of a pixel in x and y leads from 0.75 to 0.25 + 0.5 * 0.75 * 0.75,
  // which is nearer to 0.25 than the reference comes to 0.75.
  EXPECT_FLOAT_EQ(found.unexplained[pixel], 0.28125f);
  EXPECT_FLOAT_EQ(found.out_of_range[pixel], 0.5f);
  for (std::size_t k = 0; k < flat.size(); ++k) {
    if (k == pixel) continue;
    EXPECT_EQ(found.out_of_range[k], 0.0f);
  }
}

TEST(LocalDifference, AnOutlineOnTheOtherSideOfAPixelIsInRange) {
  const LocalDifference found = between(columns(0.2f, 0.8f, 10), columns(0.2f, 0.8f, 11));
  for (const float out : found.out_of_range) EXPECT_EQ(out, 0.0f);
  // A quarter of the way from 0.2 to 0.8 explains 0.35 of what is 0.8.
  EXPECT_FLOAT_EQ(found.unexplained[10], 0.45f);
}

TEST(LocalDifference, AQuarterOfAPixelExplainsWhatItMoves) {
  Plane ramp(kWidth * kHeight), moved = ramp;
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const auto x = static_cast<float>(k % kWidth);
    ramp[k] = 0.03125f * x;
    moved[k] = 0.03125f * (x + 0.25f);
  }
  const LocalDifference found = between(ramp, moved);
  for (const float unexplained : found.unexplained) EXPECT_EQ(unexplained, 0.0f);
}

TEST(LocalDifference, IsTheSameForThePicturesChangedAndForAnyThreads) {
  test_support::Random random(8);
  Plane a(kWidth * kHeight), b(kWidth * kHeight);
  for (float& value : a) value = static_cast<float>(random.uniform(0.0, 1.0));
  for (float& value : b) value = static_cast<float>(random.uniform(0.0, 1.0));
  const LocalDifference there = between(a, b), back = between(b, a);
  EXPECT_EQ(there.unexplained, back.unexplained);
  EXPECT_EQ(there.out_of_range, back.out_of_range);
  const ThreadLimit limit(7);
  EXPECT_EQ(between(a, b).unexplained, there.unexplained);
}

}  // namespace
}  // namespace plumb::compare
