// Sixteen floats side by side. For files that are compiled for AVX-512 and included nowhere else.
#pragma once

#include <immintrin.h>

namespace plumb::compare {
namespace {

/// As Sse2Floats.
struct Avx512Floats {
  static constexpr int kCount = 16;
  using Real = __m512;
  using Mask = __mmask16;
  using Whole = __m512i;

  static Real all(float x) { return _mm512_set1_ps(x); }
  static Whole all_whole(int x) { return _mm512_set1_epi32(x); }
  static Real load(const float* from) { return _mm512_loadu_ps(from); }
  static void store(float* to, Real x) { _mm512_storeu_ps(to, x); }

  static Real least(Real a, Real b) { return _mm512_min_ps(a, b); }
  static Real greatest(Real a, Real b) { return _mm512_max_ps(a, b); }
  static Real root(Real a) { return _mm512_sqrt_ps(a); }
  static Real magnitude(Real a) { return _mm512_abs_ps(a); }
  static Mask less(Real a, Real b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static Real choose(Mask m, Real a, Real b) { return _mm512_mask_blend_ps(m, b, a); }

  static Whole bits(Real x) { return _mm512_castps_si512(x); }
  static Real from_bits(Whole x) { return _mm512_castsi512_ps(x); }
  static Whole plus(Whole a, Whole b) { return _mm512_add_epi32(a, b); }
  static Whole minus(Whole a, Whole b) { return _mm512_sub_epi32(a, b); }
  template <int kBits>
  static Whole left(Whole x) {
    return _mm512_slli_epi32(x, kBits);
  }
  template <int kBits>
  static Whole right(Whole x) {
    return _mm512_srai_epi32(x, kBits);
  }
  static Real to_real(Whole x) { return _mm512_cvtepi32_ps(x); }
  static Whole to_whole(Real x) { return _mm512_cvttps_epi32(x); }
};

}  // namespace
}  // namespace plumb::compare
