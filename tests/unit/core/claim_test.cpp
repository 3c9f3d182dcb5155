#include "core/claim.h"

#include <gtest/gtest.h>

#include "core/check.h"
#include "core/hash.h"
#include "core/parallel.h"

namespace plumb {
namespace {

TEST(Tolerance, CarriesItsUnit) {
  EXPECT_EQ(parse_tolerance("1px"), (Tolerance{1.0, Unit::Pixel}));
  EXPECT_EQ(parse_tolerance("0.25px"), (Tolerance{0.25, Unit::Pixel}));
  EXPECT_EQ(parse_tolerance("5m"), (Tolerance{5.0, Unit::Metre}));
  EXPECT_EQ(parse_tolerance("0m"), (Tolerance{0.0, Unit::Metre}));
  EXPECT_EQ(to_text(parse_tolerance("0.1px")), "0.1px");
}

TEST(Tolerance, RefusesAnythingElse) {
  for (const char* text :
       {"", "1", "px", "m", "-1px", "nanpx", "infm", "1 px", "1pxx", "1cm", "0x1m"}) {
    EXPECT_THROW(parse_tolerance(text), InputError) << text;
  }
}

TEST(Checksum, TellsOrderAndLengthApart) {
  EXPECT_NE(Checksum().add(1.0).add(2.0).value(), Checksum().add(2.0).add(1.0).value());
  EXPECT_NE(Checksum().add(std::string_view("ab")).add(std::string_view("c")).value(),
            Checksum().add(std::string_view("a")).add(std::string_view("bc")).value());
  EXPECT_NE(Checksum().add(0.0).value(), Checksum().add(-0.0).value());  // bits, not values
  EXPECT_EQ(Checksum().text().size(), 16u);
}

// Sums of numbers that rounding makes order-dependent: the same bits on any number of threads.
TEST(ParallelOrderedReduce, DoesNotDependOnThreads) {
  const auto sum = [](int threads) {
    const ThreadLimit limit(threads);
    return parallel_ordered_reduce(
        1'000'000, 1000, 0.0,
        [](std::int64_t begin, std::int64_t end, double value) {
          for (std::int64_t k = begin; k < end; ++k) value += 1.0 / static_cast<double>(k + 1);
          return value;
        },
        [](double a, double b) { return a + b; });
  };
  const double one = sum(1);
  EXPECT_EQ(one, sum(2));
  EXPECT_EQ(one, sum(7));
}

}  // namespace
}  // namespace plumb
