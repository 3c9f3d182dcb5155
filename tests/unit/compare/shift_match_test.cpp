#include "compare/shift_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace plumb::compare {
namespace {

constexpr int kWidth = 40, kHeight = 30;
using Plane = std::vector<float>;

Plane columns_of(int shift) {
  Plane plane(kWidth * kHeight);
  for (int k = 0; k < kWidth * kHeight; ++k)
    plane[static_cast<std::size_t>(k)] = static_cast<float>(((k % kWidth + shift) / 4) % 7) / 7.0f;
  return plane;
}

int unmatched(const Plane& a, const Plane& b, const ShiftMatchOptions& options = {}) {
  const std::array<std::span<const float>, 1> reference{a}, candidate{b};
  const auto found = unmatched_pixels(reference, candidate, kWidth, kHeight, options);
  return std::accumulate(found.begin(), found.end(), 0);
}

TEST(ShiftMatch, ForgivesAShiftByItsRadius) {
  // Stripes of four columns, none of which enters or leaves at the rims.
  EXPECT_EQ(unmatched(columns_of(1), columns_of(2)), 0);
  EXPECT_GT(unmatched(columns_of(1), columns_of(3)), 0);
  EXPECT_EQ(unmatched(columns_of(1), columns_of(3), {2, 0.0}), 0);
}

TEST(ShiftMatch, ForgivesWhatIsWithinItsTolerance) {
  Plane brighter = columns_of(0);
  for (float& value : brighter) value += 0.01f;
  EXPECT_EQ(unmatched(columns_of(0), brighter, {1, 0.0101}), 0);
  EXPECT_EQ(unmatched(columns_of(0), brighter, {0, 0.0099}), kWidth * kHeight);
}

// A single pixel that is like none: itself in one direction, and nobody misses it in the other.
TEST(ShiftMatch, FindsAPinhole) {
  const Plane flat(kWidth * kHeight, 0.5f);
  Plane pinhole = flat;
  pinhole[15 * kWidth + 20] = 1.0f;
  EXPECT_EQ(unmatched(flat, pinhole), 1);
  EXPECT_EQ(unmatched(pinhole, flat), 1);
}

TEST(ShiftMatch, AsksForEveryChannelAtOnce) {
  const Plane a = columns_of(0), b = columns_of(1);
  const std::array<std::span<const float>, 2> reference{a, b}, candidate{b, a};
  const auto found = unmatched_pixels(reference, candidate, kWidth, kHeight, {1, 0.0});
  EXPECT_GT(std::count(found.begin(), found.end(), 1), 0);
}

TEST(ShiftMatch, RefusesUnlikeShapes) {
  const Plane a(kWidth * kHeight), b(3);
  const std::array<std::span<const float>, 1> reference{a}, candidate{b};
  EXPECT_THROW(unmatched_pixels(reference, candidate, kWidth, kHeight), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::compare
