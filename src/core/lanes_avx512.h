// Eight doubles side by side. For files that are compiled for AVX-512 and included nowhere else.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace plumb {
namespace {

/// As Sse2Lanes.
struct Avx512Lanes {
  static constexpr int kCount = 8;
  using Real = __m512d;
  using Mask = __mmask8;

  static Real all(double x) { return _mm512_set1_pd(x); }
  static Real load(const double* from) { return _mm512_loadu_pd(from); }
  static Real load(const float* from) { return _mm512_cvtps_pd(_mm256_loadu_ps(from)); }
  static void store(double* to, Real x) { _mm512_storeu_pd(to, x); }
  static void store(float* to, Real x) { _mm256_storeu_ps(to, _mm512_cvtpd_ps(x)); }
  static void store_whole(std::int32_t* to, Real x) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvttpd_epi32(x));
  }

  static Real least(Real a, Real b) { return _mm512_min_pd(a, b); }
  static Real greatest(Real a, Real b) { return _mm512_max_pd(a, b); }
  static Real root(Real a) { return _mm512_sqrt_pd(a); }
  static Real magnitude(Real a) { return _mm512_abs_pd(a); }
  static Real floor(Real x) {
    return _mm512_roundscale_pd(x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
  }

  static Mask less(Real a, Real b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
  static Mask less_equal(Real a, Real b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
  static Mask equal(Real a, Real b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
  static Mask both(Mask a, Mask b) { return mask(unsigned{a} & unsigned{b}); }
  static Mask either(Mask a, Mask b) { return mask(unsigned{a} | unsigned{b}); }
  static Mask without(Mask a, Mask b) { return mask(unsigned{a} & ~unsigned{b}); }
  static Mask same(Mask a, Mask b) { return mask(~(unsigned{a} ^ unsigned{b})); }
  static Real choose(Mask m, Real a, Real b) { return _mm512_mask_blend_pd(m, b, a); }
  static unsigned bits(Mask m) { return m; }
  static Mask mask(unsigned bits) { return static_cast<Mask>(bits); }

  static Real spread(Real x, Mask m, const double* from) {
    return _mm512_mask_expandloadu_pd(x, m, from);
  }

  struct Table {
    __m512d low, high;
  };
  static Table table(const double* entries) { return {load(entries), load(entries + 8)}; }
  static Real look_up(const Table& table, Real index) {
    return _mm512_permutex2var_pd(table.low, _mm512_castpd_si512(index), table.high);
  }

  struct Pair {
    Real first, second;
  };
  template <int kStride>
  static Pair gather(const float* base, Real index, Mask m) {
    const __m512i pairs = _mm512_mask_i32gather_epi64(
        _mm512_setzero_si512(), m, _mm512_cvttpd_epi32(index), base, kStride * 4);
    const __m256i first = _mm512_cvtepi64_epi32(pairs);
    const __m256i second = _mm512_cvtepi64_epi32(_mm512_srli_epi64(pairs, 32));
    return {_mm512_cvtps_pd(_mm256_castsi256_ps(first)),
            _mm512_cvtps_pd(_mm256_castsi256_ps(second))};
  }
};

}  // namespace
}  // namespace plumb
