#include "core/reproducible_math.h"

#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/lanes_sse2.h"

namespace plumb {
namespace {

// pi/2 in three parts of at most 33 significant bits, so that products with a quadrant number below
// 2^20 are exact.
constexpr double kHalfPiHigh = 1.57079632673412561417e+00;
constexpr double kHalfPiMiddle = 6.07710050630396597660e-11;
constexpr double kHalfPiLow = 2.02226624879595063154e-21;
constexpr double kLn2High = 6.93147180369123816490e-01;  // 33 bits
constexpr double kLn2Low = 1.90821492927058770002e-10;
constexpr double kLn2 = 0.69314718055994530942;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Reduced {
  double angle;  // in [-pi/4, pi/4]
  int quadrant;  // 0..3
};

Reduced reduce(double angle) {
  const double turns = std::floor(angle * (2.0 / kPi) + 0.5);
  const double rest = ((angle - turns * kHalfPiHigh) - turns * kHalfPiMiddle) - turns * kHalfPiLow;
  return {rest, static_cast<int>(static_cast<long long>(turns) & 3)};
}

// Taylor series on |x| <= pi/4: the first term left out is below 1e-19.
double sine_series(double x) {
  const double square = x * x;
  double term = x, sum = 0.0;
  double terms[9];
  for (int k = 0; k < 9; ++k) {
    terms[k] = term;
    term = -term * square / ((2 * k + 2) * (2 * k + 3));
  }
  for (int k = 8; k >= 0; --k) sum += terms[k];
  return sum;
}

double cosine_series(double x) {
  const double square = x * x;
  double term = 1.0, sum = 0.0;
  double terms[10];
  for (int k = 0; k < 10; ++k) {
    terms[k] = term;
    term = -term * square / ((2 * k + 1) * (2 * k + 2));
  }
  for (int k = 9; k >= 0; --k) sum += terms[k];
  return sum;
}

// reproducible_atan of two tangents in [-1, 1], step by step.
__m128d atan_pair(__m128d tangent) {
  using L = Sse2Lanes;
  const __m128d one = L::all(1.0);
  __m128d x = L::magnitude(tangent);
  for (int k = 0; k < 3; ++k) x = x / (one + L::root(one + x * x));
  const __m128d square = x * x;
  __m128d sum = L::all(0.0);
  for (int k = 9; k >= 1; --k) sum = square * (L::all((k & 1 ? -1.0 : 1.0) / (2 * k + 1)) + sum);
  const __m128d angle = L::all(8.0) * (x + x * sum);
  return L::choose(L::less(tangent, L::all(0.0)), L::all(-1.0) * angle, angle);
}

// reproducible_atan2 of two vectors.
__m128d atan2_pair(__m128d y, __m128d x) {
  using L = Sse2Lanes;
  const __m128d zero = L::all(0.0), quarter = L::all(kPi / 2.0), half = L::all(kPi);
  const auto steep = L::less(L::magnitude(x), L::magnitude(y));
  const __m128d angle = atan_pair(L::choose(steep, x, y) / L::choose(steep, y, x));
  const __m128d behind = L::choose(L::less(y, zero), angle - half, angle + half);
  const __m128d flat = L::choose(L::less(zero, x), angle, behind);
  const __m128d up = L::choose(L::less(zero, y), quarter, zero - quarter) - angle;
  const auto none = L::both(L::equal(x, zero), L::equal(y, zero));
  return L::choose(none, zero, L::choose(steep, up, flat));
}

}  // namespace

double reproducible_sin(double angle_rad) {
  if (!(std::abs(angle_rad) <= 1e6)) return kNaN;
  const Reduced r = reduce(angle_rad);
  const double value = r.quadrant & 1 ? cosine_series(r.angle) : sine_series(r.angle);
  return r.quadrant & 2 ? -value : value;
}

double reproducible_cos(double angle_rad) {
  if (!(std::abs(angle_rad) <= 1e6)) return kNaN;
  const Reduced r = reduce(angle_rad);
  const double value = r.quadrant & 1 ? sine_series(r.angle) : cosine_series(r.angle);
  return r.quadrant == 1 || r.quadrant == 2 ? -value : value;
}

double reproducible_tan(double angle_rad) {
  return reproducible_sin(angle_rad) / reproducible_cos(angle_rad);
}

double reproducible_atan(double tangent) {
  if (std::isnan(tangent)) return kNaN;
  double x = std::abs(tangent);
  const bool inverted = x > 1.0;
  if (inverted) x = 1.0 / x;
  // Halve the angle three times: |x| <= tan(pi/32) < 0.0985, where 9 terms leave less than 1e-19.
  for (int k = 0; k < 3; ++k) x = x / (1.0 + std::sqrt(1.0 + x * x));
  const double square = x * x;
  double sum = 0.0;
  for (int k = 9; k >= 1; --k) sum = square * ((k & 1 ? -1.0 : 1.0) / (2 * k + 1) + sum);
  double angle = 8.0 * (x + x * sum);
  if (inverted) angle = kPi / 2.0 - angle;
  return tangent < 0.0 ? -angle : angle;
}

double reproducible_atan2(double y, double x) {
  if (x == 0.0 && y == 0.0) return 0.0;
  if (std::abs(y) > std::abs(x))
    return (y > 0.0 ? kPi / 2.0 : -kPi / 2.0) - reproducible_atan(x / y);
  const double angle = reproducible_atan(y / x);
  if (x > 0.0) return angle;
  return y < 0.0 ? angle - kPi : angle + kPi;
}

void reproducible_atan2(std::span<const double> y, std::span<const double> x,
                        std::span<double> angle_rad) {
  using L = Sse2Lanes;
  require(y.size() == x.size() && y.size() == angle_rad.size(),
          "spans must have one length, got {}, {} and {}", y.size(), x.size(), angle_rad.size());
  std::size_t k = 0;
  for (; k + L::kCount <= y.size(); k += L::kCount)
    L::store(&angle_rad[k], atan2_pair(L::load(&y[k]), L::load(&x[k])));
  for (; k < y.size(); ++k) angle_rad[k] = reproducible_atan2(y[k], x[k]);
}

double reproducible_log(double x) {
  if (std::isnan(x) || x < 0.0) return kNaN;
  if (x == 0.0) return -kInfinity;
  if (x == kInfinity) return x;
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // in [1/2, 1)
  if (mantissa < 0.70710678118654752440) {
    mantissa *= 2.0;
    --exponent;
  }
  // log m = 2 artanh(s), s = (m - 1) / (m + 1), |s| < 0.1716; the first term left out is below
  // 1e-19.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double square = s * s;
  double sum = 0.0;
  for (int k = 12; k >= 1; --k) sum = square * (1.0 / (2 * k + 1) + sum);
  const double series = 2.0 * (s + s * sum);
  return exponent * kLn2High + (exponent * kLn2Low + series);
}

double reproducible_log2(double x) {
  int exponent = 0;
  if (x > 0.0 && std::isfinite(x) && std::frexp(x, &exponent) == 0.5)
    return exponent - 1;  // a power of two is exact
  return reproducible_log(x) / kLn2;
}

double reproducible_exp(double x) {
  if (std::isnan(x)) return kNaN;
  if (x > 709.78) return kInfinity;
  if (x < -745.2) return 0.0;
  const double count = std::floor(x / kLn2 + 0.5);
  const double rest = (x - count * kLn2High) - count * kLn2Low;  // |rest| <= 0.3466
  double sum = 0.0;
  for (int k = 15; k >= 1; --k) sum = (1.0 + sum) * rest / k;
  return std::ldexp(1.0 + sum, static_cast<int>(count));
}

double reproducible_pow(double base, double exponent) {
  if (exponent == 0.0 || base == 1.0) return 1.0;
  if (base == 0.0) return exponent > 0.0 ? 0.0 : kInfinity;
  return reproducible_exp(exponent * reproducible_log(base));
}

}  // namespace plumb
