// Eight floats side by side. For files that are compiled for AVX2 and included nowhere else.
#pragma once

#include <immintrin.h>

namespace plumb::compare {
namespace {

/// As Sse2Floats.
struct Avx2Floats {
  static constexpr int kCount = 8;
  using Real = __m256;
  using Mask = __m256;
  using Whole = __m256i;

  static Real all(float x) { return _mm256_set1_ps(x); }
  static Whole all_whole(int x) { return _mm256_set1_epi32(x); }
  static Real load(const float* from) { return _mm256_loadu_ps(from); }
  static void store(float* to, Real x) { _mm256_storeu_ps(to, x); }

  static Real least(Real a, Real b) { return _mm256_min_ps(a, b); }
  static Real greatest(Real a, Real b) { return _mm256_max_ps(a, b); }
  static Real root(Real a) { return _mm256_sqrt_ps(a); }
  static Real magnitude(Real a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
  static Mask less(Real a, Real b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static Real choose(Mask m, Real a, Real b) { return _mm256_blendv_ps(b, a, m); }

  static Whole bits(Real x) { return _mm256_castps_si256(x); }
  static Real from_bits(Whole x) { return _mm256_castsi256_ps(x); }
  static Whole plus(Whole a, Whole b) { return _mm256_add_epi32(a, b); }
  static Whole minus(Whole a, Whole b) { return _mm256_sub_epi32(a, b); }
  template <int kBits>
  static Whole left(Whole x) {
    return _mm256_slli_epi32(x, kBits);
  }
  template <int kBits>
  static Whole right(Whole x) {
    return _mm256_srai_epi32(x, kBits);
  }
  static Real to_real(Whole x) { return _mm256_cvtepi32_ps(x); }
  static Whole to_whole(Real x) { return _mm256_cvttps_epi32(x); }
};

}  // namespace
}  // namespace plumb::compare
