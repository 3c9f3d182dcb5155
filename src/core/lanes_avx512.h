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

  static void load_points(const double* from, Real& x, Real& y, Real& z) {
    const Real a = load(from), b = load(from + 8), c = load(from + 16);
    const auto third = [&](__m512i of_ab, __m512i with_c) {
      return _mm512_permutex2var_pd(_mm512_permutex2var_pd(a, of_ab, b), with_c, c);
    };
    x = third(_mm512_setr_epi64(0, 3, 6, 9, 12, 15, 0, 0),
              _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 10, 13));
    y = third(_mm512_setr_epi64(1, 4, 7, 10, 13, 0, 0, 0),
              _mm512_setr_epi64(0, 1, 2, 3, 4, 8, 11, 14));
    z = third(_mm512_setr_epi64(2, 5, 8, 11, 14, 0, 0, 0),
              _mm512_setr_epi64(0, 1, 2, 3, 4, 9, 12, 15));
  }
  static void store_records(void* to, Real first, Real second, Real third) {
    const __m512i low = _mm512_cvtepu32_epi64(_mm512_cvttpd_epi32(first));
    const __m512i high = _mm512_cvtepu32_epi64(_mm512_cvttpd_epi32(second));
    const __m512i both = _mm512_or_si512(low, _mm512_slli_epi64(high, 32));
    const __m512i reals = _mm512_castpd_si512(third);
    const __m512i begin = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11);
    const __m512i end = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
    auto* records = static_cast<char*>(to);
    _mm512_storeu_si512(records, _mm512_permutex2var_epi64(both, begin, reals));
    _mm512_storeu_si512(records + 64, _mm512_permutex2var_epi64(both, end, reals));
  }

  static Real least(Real a, Real b) { return _mm512_min_pd(a, b); }
  static Real greatest(Real a, Real b) { return _mm512_max_pd(a, b); }
  static Real root(Real a) { return _mm512_sqrt_pd(a); }
  static Real magnitude(Real a) { return _mm512_abs_pd(a); }
  static Real to_float(Real x) { return _mm512_cvtps_pd(_mm512_cvtpd_ps(x)); }
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
  template <int kStride>
  static Pair gather(const std::uint16_t* base, Real index, Mask m, int more) {
    const __m256i pairs = _mm256_mmask_i32gather_epi32(
        _mm256_setzero_si256(), m, _mm512_cvttpd_epi32(index), base, kStride * 2);
    const __m256i plus = _mm256_set1_epi32(more);
    const __m256i first = _mm256_and_si256(pairs, _mm256_set1_epi32(0xffff));
    const __m256i second = _mm256_srli_epi32(pairs, 16);
    return {_mm512_cvtepi32_pd(_mm256_add_epi32(first, plus)),
            _mm512_cvtepi32_pd(_mm256_add_epi32(second, plus))};
  }
};

}  // namespace
}  // namespace plumb
