// Four doubles side by side. For files that are compiled for AVX2 and included nowhere else.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace plumb {
namespace {

/// As Sse2Lanes.
struct Avx2Lanes {
  static constexpr int kCount = 4;
  using Real = __m256d;
  using Mask = __m256d;

  static Real all(double x) { return _mm256_set1_pd(x); }
  static Real load(const double* from) { return _mm256_loadu_pd(from); }
  static Real load(const float* from) { return _mm256_cvtps_pd(_mm_loadu_ps(from)); }
  static void store(double* to, Real x) { _mm256_storeu_pd(to, x); }
  static void store(float* to, Real x) { _mm_storeu_ps(to, _mm256_cvtpd_ps(x)); }
  static void store_whole(std::int32_t* to, Real x) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvttpd_epi32(x));
  }

  static void load_points(const double* from, Real& x, Real& y, Real& z) {
    const auto halves = [from](int low, int high) {
      return _mm256_set_m128d(_mm_loadu_pd(from + high), _mm_loadu_pd(from + low));
    };
    const Real xy0 = halves(0, 6), z0x1 = halves(2, 8), yz1 = halves(4, 10);
    x = _mm256_shuffle_pd(xy0, z0x1, 0b1010);
    y = _mm256_shuffle_pd(xy0, yz1, 0b0101);
    z = _mm256_shuffle_pd(z0x1, yz1, 0b1010);
  }
  static void store_records(void* to, Real first, Real second, Real third) {
    const __m128i one = _mm256_cvttpd_epi32(first), two = _mm256_cvttpd_epi32(second);
    const __m128i low = _mm_unpacklo_epi32(one, two), high = _mm_unpackhi_epi32(one, two);
    const __m128i real_low = _mm_castpd_si128(_mm256_castpd256_pd128(third));
    const __m128i real_high = _mm_castpd_si128(_mm256_extractf128_pd(third, 1));
    auto* records = static_cast<__m128i*>(to);
    _mm_storeu_si128(records, _mm_unpacklo_epi64(low, real_low));
    _mm_storeu_si128(records + 1, _mm_unpackhi_epi64(low, real_low));
    _mm_storeu_si128(records + 2, _mm_unpacklo_epi64(high, real_high));
    _mm_storeu_si128(records + 3, _mm_unpackhi_epi64(high, real_high));
  }

  static Real least(Real a, Real b) { return _mm256_min_pd(a, b); }
  static Real greatest(Real a, Real b) { return _mm256_max_pd(a, b); }
  static Real root(Real a) { return _mm256_sqrt_pd(a); }
  static Real magnitude(Real a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
  static Real to_float(Real x) { return _mm256_cvtps_pd(_mm256_cvtpd_ps(x)); }
  static Real floor(Real x) { return _mm256_floor_pd(x); }

  static Mask less(Real a, Real b) { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
  static Mask less_equal(Real a, Real b) { return _mm256_cmp_pd(a, b, _CMP_LE_OQ); }
  static Mask equal(Real a, Real b) { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); }
  static Mask both(Mask a, Mask b) { return _mm256_and_pd(a, b); }
  static Mask either(Mask a, Mask b) { return _mm256_or_pd(a, b); }
  static Mask without(Mask a, Mask b) { return _mm256_andnot_pd(b, a); }
  static Mask same(Mask a, Mask b) {
    const Mask different = _mm256_xor_pd(a, b);
    return _mm256_xor_pd(different, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)));
  }
  static Real choose(Mask m, Real a, Real b) { return _mm256_blendv_pd(b, a, m); }
  static unsigned bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_pd(m)); }
  static Mask mask(unsigned bits) {
    const __m256i lane_bit = _mm256_set_epi64x(8, 4, 2, 1);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi64x(bits), lane_bit);
    return _mm256_castsi256_pd(_mm256_cmpeq_epi64(set, lane_bit));
  }

  static Real spread(Real x, Mask m, const double* from) {
    double lane[kCount];
    store(lane, x);
    for (unsigned left = bits(m); left; left &= left - 1) lane[__builtin_ctz(left)] = *from++;
    return load(lane);
  }

  struct Table {
    const double* entries;
  };
  static Table table(const double* entries) { return {entries}; }
  static Real look_up(const Table& table, Real index) {
    const __m256i mask = _mm256_set1_epi64x(15);
    return _mm256_i64gather_pd(table.entries, _mm256_and_si256(_mm256_castpd_si256(index), mask),
                               8);
  }

  struct Pair {
    Real first, second;
  };
  template <int kStride>
  static Pair gather(const float* base, Real index, Mask m) {
    const __m128i i = _mm256_cvttpd_epi32(index);
    const __m256i pairs = _mm256_mask_i32gather_epi64(_mm256_setzero_si256(),
                                                      reinterpret_cast<const long long*>(base), i,
                                                      _mm256_castpd_si256(m), kStride * 4);
    // Even floats to the lower half, odd ones to the upper.
    const __m256i apart =
        _mm256_permutevar8x32_epi32(pairs, _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7));
    return {_mm256_cvtps_pd(_mm_castsi128_ps(_mm256_castsi256_si128(apart))),
            _mm256_cvtps_pd(_mm_castsi128_ps(_mm256_extracti128_si256(apart, 1)))};
  }
  template <int kStride>
  static Pair gather(const std::uint16_t* base, Real index, Mask m, int more) {
    const __m256i even = _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6);
    const __m256i narrow = _mm256_permutevar8x32_epi32(_mm256_castpd_si256(m), even);
    const __m128i pairs = _mm_mask_i32gather_epi32(
        _mm_setzero_si128(), reinterpret_cast<const int*>(base), _mm256_cvttpd_epi32(index),
        _mm256_castsi256_si128(narrow), kStride * 2);
    const __m128i plus = _mm_set1_epi32(more);
    const __m128i first = _mm_and_si128(pairs, _mm_set1_epi32(0xffff));
    const __m128i second = _mm_srli_epi32(pairs, 16);
    return {_mm256_cvtepi32_pd(_mm_add_epi32(first, plus)),
            _mm256_cvtepi32_pd(_mm_add_epi32(second, plus))};
  }
};

}  // namespace
}  // namespace plumb
