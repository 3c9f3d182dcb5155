// Powers of floats, several at a time, from additions, multiplications and divisions alone.
// Included by one file for each instruction set.
#pragma once

namespace plumb::compare {
namespace {

template <class L>
struct Powers {
  using Real = typename L::Real;
  using Whole = typename L::Whole;

  // Binary logarithm of x > 0, no subnormal. With x = 2^e m, m in [sqrt(1/2), sqrt(2)), and
  // s = (m - 1) / (m + 1): log m = 2 artanh s, |s| < 0.1716; the first term left out, 2 s^11 / 11,
  // is below 8e-10.
  static Real log2(Real x) {
    const Whole half_root = L::all_whole(0x3f3504f3);  // the bits of sqrt(1/2)
    const Whole exponent = L::template right<23>(L::minus(L::bits(x), half_root));
    const Real m = L::from_bits(L::minus(L::bits(x), L::template left<23>(exponent)));
    const Real one = L::all(1.0f);
    const Real s = (m - one) / (m + one), square = s * s;
    constexpr double kTwoOverLn2 = 2.8853900817779268147;
    Real sum = L::all(static_cast<float>(kTwoOverLn2 / 9.0));
    constexpr double kOdd[] = {7.0, 5.0, 3.0, 1.0};
    for (const double odd : kOdd)
      sum = sum * square + L::all(static_cast<float>(kTwoOverLn2 / odd));
    return L::to_real(exponent) + s * sum;
  }

  // 2^x for x <= 127; 2^-126 for what is less than -126. The rest r of x beside the nearest whole
  // number has |r ln 2| <= 0.3466: the first term left out, to the eighth over 8!, is below 6e-9.
  static Real exp2(Real x) {
    const Real bounded = L::greatest(x, L::all(-126.0f));
    const Real shift = L::all(12582912.0f);  // 1.5 * 2^23: adding it rounds to a whole number
    const Real whole = (bounded + shift) - shift;
    const Real rest = (bounded - whole) * L::all(0.69314718f);
    Real sum = L::all(1.0f / 5040.0f);
    constexpr float kFactorials[] = {720.0f, 120.0f, 24.0f, 6.0f, 2.0f, 1.0f, 1.0f};
    for (const float factorial : kFactorials) sum = sum * rest + L::all(1.0f / factorial);
    const Whole bits = L::plus(L::to_whole(whole), L::all_whole(127));
    return sum * L::from_bits(L::template left<23>(bits));
  }

  // x^exponent for x >= 0 and exponent > 0; 0 for x below the least normal float. Relative error
  // below 1e-6 for exponents up to 2.4 and results above 1e-5.
  static Real power(Real x, Real exponent) {
    const Real tiny = L::all(1.17549435e-38f);
    const Real result = exp2(exponent * log2(L::greatest(x, tiny)));
    return L::choose(L::less(x, tiny), L::all(0.0f), result);
  }
};

}  // namespace
}  // namespace plumb::compare
