#include "core/reproducible_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace plumb {
namespace {

// The C library's long double functions are the reference: 64 bits of mantissa, so their own error
// is far below ours.
TEST(ReproducibleMath, AgreesWithTheLibraryToAFewUlp) {
  for (int k = -4000; k <= 4000; ++k) {
    const double x = k * 0.01237;
    // Errors are stated in the header: absolute for sine and cosine, growing by 1e-16 a radian.
    const double slack = 4e-16 + 1e-16 * std::abs(x);
    EXPECT_NEAR(reproducible_sin(x), static_cast<double>(sinl(x)), slack) << x;
    EXPECT_NEAR(reproducible_cos(x), static_cast<double>(cosl(x)), slack) << x;
    EXPECT_NEAR(reproducible_atan(x), static_cast<double>(atanl(x)),
                1e-15 * std::abs(static_cast<double>(atanl(x))))
        << x;
    EXPECT_NEAR(reproducible_exp(x), static_cast<double>(expl(x)),
                1e-15 * std::max(1.0, std::abs(x)) * static_cast<double>(expl(x)))
        << x;
    if (k > 0) {
      const auto log = static_cast<double>(logl(x));
      EXPECT_NEAR(reproducible_log(x), log, 4e-16 * std::max(1.0, std::abs(log))) << x;
    }
  }
}

TEST(ReproducibleMath, TangentOfFieldsOfView) {
  for (double degrees_half = 0.5; degrees_half < 89.0; degrees_half += 0.5) {
    const double expected =
        static_cast<double>(tanl(static_cast<long double>(radians(degrees_half))));
    EXPECT_NEAR(reproducible_tan(radians(degrees_half)), expected,
                1e-15 * expected * std::max(1.0, expected));
  }
}

TEST(ReproducibleMath, KnowsTheQuadrants) {
  EXPECT_EQ(reproducible_atan2(0.0, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(reproducible_atan2(1.0, 0.0), kPi / 2);
  EXPECT_DOUBLE_EQ(reproducible_atan2(0.0, -1.0), kPi);
  EXPECT_DOUBLE_EQ(reproducible_atan2(-1.0, -1.0), -0.75 * kPi);
  EXPECT_EQ(reproducible_atan2(0.0, 0.0), 0.0);
}

TEST(ReproducibleMath, GivesTheSameBitsForManyAnglesAsForOne) {
  std::vector<double> y, x;
  const double edges[] = {0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, 1e300, -1e300, 0.3};
  for (const double a : edges) {
    for (const double b : edges) {
      y.push_back(a);
      x.push_back(b);
    }
  }
  for (int k = 0; k < 2000; ++k) {
    y.push_back(reproducible_sin(0.7 * k) * (1 + k % 7));
    x.push_back(reproducible_cos(1.3 * k) * (1 + k % 5));
  }
  std::vector<double> angles(y.size());  // an odd number: the last is alone
  ASSERT_EQ(angles.size() % 2, 1u);
  reproducible_atan2(y, x, angles);
  for (std::size_t k = 0; k < y.size(); ++k) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(angles[k]),
              std::bit_cast<std::uint64_t>(reproducible_atan2(y[k], x[k])))
        << y[k] << ' ' << x[k];
  }
  EXPECT_THROW(reproducible_atan2(y, x, std::span(angles).first(3)), std::invalid_argument);
}

TEST(ReproducibleMath, IsExactWhereItCanBe) {
  for (int k = -1000; k <= 1000; ++k) EXPECT_EQ(reproducible_log2(std::ldexp(1.0, k)), k);
  EXPECT_EQ(reproducible_exp(0.0), 1.0);
  EXPECT_EQ(reproducible_pow(2.0, 0.0), 1.0);
  EXPECT_EQ(reproducible_pow(0.0, 2.0), 0.0);
  EXPECT_EQ(reproducible_sin(0.0), 0.0);
}

TEST(ReproducibleMath, HasItsEdges) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reproducible_log(0.0), -infinity);
  EXPECT_TRUE(std::isnan(reproducible_log(-1.0)));
  EXPECT_EQ(reproducible_exp(1000.0), infinity);
  EXPECT_EQ(reproducible_exp(-1000.0), 0.0);
  EXPECT_TRUE(std::isnan(reproducible_sin(1e7)));
  EXPECT_TRUE(std::isnan(reproducible_exp(std::nan(""))));
}

}  // namespace
}  // namespace plumb
