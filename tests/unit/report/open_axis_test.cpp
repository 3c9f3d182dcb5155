#include "report/open_axis.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace plumb::report {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::string ticks_of(const std::vector<double>& values) {
  std::string all;
  for (const OpenTick& tick : open_axis(values).ticks) all += (all.empty() ? "" : " ") + tick.text;
  return all;
}

TEST(OpenAxis, HasTicksAtOnesTwosAndFivesAroundItsValues) {
  EXPECT_EQ(ticks_of({0.03, 0.7}), "0.02 0.05 0.1 0.2 0.5 1");
  EXPECT_EQ(ticks_of({3.0}), "2 5");
  EXPECT_EQ(ticks_of({10.0}), "10 20");
}

TEST(OpenAxis, HasPowersOfTenAloneWhereItIsLong) {
  EXPECT_EQ(ticks_of({0.03, 700.0}), "0.01 0.1 1 10 100 1000");
  EXPECT_EQ(ticks_of({2e5, 3e9}), "1e5 1e6 1e7 1e8 1e9 1e10");
}

// From 0.1 to 10 is two decades; an eighth of them is a quarter.
TEST(OpenAxis, SetsZeroAndInfinityApart) {
  const OpenAxis axis = open_axis(std::vector<double>{0.0, 0.1, 10.0, kInfinite});
  EXPECT_DOUBLE_EQ(axis.place(0.0), -1.25);
  EXPECT_DOUBLE_EQ(axis.place(kInfinite), 1.25);
  EXPECT_DOUBLE_EQ(axis.place(1.0), 0.0);
  EXPECT_LT(axis.low, axis.place(0.0));
  EXPECT_GT(axis.high, axis.place(kInfinite));
  EXPECT_EQ(axis.ticks.front().text, "0");
  EXPECT_EQ(axis.ticks.back().text, "\xE2\x88\x9E");
}

TEST(OpenAxis, HasNoPlacesApartThatNoValueNeeds) {
  const OpenAxis axis = open_axis(std::vector<double>{0.1, 10.0});
  EXPECT_FALSE(axis.zero_at || axis.infinite_at);
  EXPECT_EQ(axis.low, axis.first);
  EXPECT_EQ(axis.high, axis.last);
}

TEST(OpenAxis, OfZerosAloneHasAPlaceForThem) {
  const OpenAxis axis = open_axis(std::vector<double>{0.0, 0.0});
  EXPECT_LT(axis.place(0.0), axis.first);
  EXPECT_EQ(ticks_of({0.0}), "0 0.1 0.2 0.5 1");
}

TEST(OpenAxis, RefusesWhatHasNoPlace) {
  EXPECT_THROW(open_axis(std::vector<double>{-1.0}), std::invalid_argument);
  EXPECT_THROW(open_axis(std::vector<double>{std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumb::report
