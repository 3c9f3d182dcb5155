// Four floats side by side: what every x86-64 processor has.
#pragma once

#include <emmintrin.h>

namespace plumb::compare {
namespace {

/// Arithmetic on several floats at once, one a lane. Every operation gives each lane what IEEE 754
/// gives a float alone, whatever the number of lanes; flip_lanes_avx2.h and flip_lanes_avx512.h
/// offer the same names, so that a kernel is written once.
struct Sse2Floats {
  static constexpr int kCount = 4;
  using Real = __m128;
  using Mask = __m128;    // all bits of a lane, or none
  using Whole = __m128i;  // of 32 bits

  static Real all(float x) { return _mm_set1_ps(x); }
  static Whole all_whole(int x) { return _mm_set1_epi32(x); }
  static Real load(const float* from) { return _mm_loadu_ps(from); }
  static void store(float* to, Real x) { _mm_storeu_ps(to, x); }

  static Real least(Real a, Real b) { return _mm_min_ps(a, b); }
  static Real greatest(Real a, Real b) { return _mm_max_ps(a, b); }
  static Real root(Real a) { return _mm_sqrt_ps(a); }
  static Real magnitude(Real a) { return _mm_andnot_ps(_mm_set1_ps(-0.0f), a); }
  static Mask less(Real a, Real b) { return _mm_cmplt_ps(a, b); }
  static Real choose(Mask m, Real a, Real b) {
    return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b));
  }

  static Whole bits(Real x) { return _mm_castps_si128(x); }
  static Real from_bits(Whole x) { return _mm_castsi128_ps(x); }
  static Whole plus(Whole a, Whole b) { return _mm_add_epi32(a, b); }
  static Whole minus(Whole a, Whole b) { return _mm_sub_epi32(a, b); }
  template <int kBits>
  static Whole left(Whole x) {
    return _mm_slli_epi32(x, kBits);
  }
  template <int kBits>  // keeps the sign
  static Whole right(Whole x) {
    return _mm_srai_epi32(x, kBits);
  }
  static Real to_real(Whole x) { return _mm_cvtepi32_ps(x); }
  static Whole to_whole(Real x) { return _mm_cvttps_epi32(x); }  // x a whole number
};

}  // namespace
}  // namespace plumb::compare
