// Two doubles side by side: what every x86-64 processor has.
#pragma once

#include <emmintrin.h>

#include <cstdint>

namespace plumb {
namespace {

/// Arithmetic on several doubles at once, one a lane. Every operation gives each lane what IEEE 754
/// gives a double alone, whatever the number of lanes; lanes_avx2.h and lanes_avx512.h offer the
/// same names, so that a kernel is written once.
struct Sse2Lanes {
  static constexpr int kCount = 2;
  using Real = __m128d;
  using Mask = __m128d;  // all bits of a lane, or none

  static Real all(double x) { return _mm_set1_pd(x); }
  static Real load(const double* from) { return _mm_loadu_pd(from); }
  static Real load(const float* from) {
    return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from))));
  }
  static void store(double* to, Real x) { _mm_storeu_pd(to, x); }
  static void store(float* to, Real x) {
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_castps_si128(_mm_cvtpd_ps(x)));
  }
  /// Whole numbers of 32 bits to `to`.
  static void store_whole(std::int32_t* to, Real x) {
    _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_cvttpd_epi32(x));
  }

  /// The next kCount points of records (x, y, z).
  static void load_points(const double* from, Real& x, Real& y, Real& z) {
    const Real xy0 = load(from), z0x1 = load(from + 2), yz1 = load(from + 4);
    x = _mm_shuffle_pd(xy0, z0x1, 0b10);
    y = _mm_shuffle_pd(xy0, yz1, 0b01);
    z = _mm_shuffle_pd(z0x1, yz1, 0b10);
  }
  /// Records of 16 bytes: two whole numbers of 32 bits and a double.
  static void store_records(void* to, Real first, Real second, Real third) {
    const __m128i both = _mm_unpacklo_epi32(_mm_cvttpd_epi32(first), _mm_cvttpd_epi32(second));
    const __m128i reals = _mm_castpd_si128(third);
    auto* records = static_cast<__m128i*>(to);
    _mm_storeu_si128(records, _mm_unpacklo_epi64(both, reals));
    _mm_storeu_si128(records + 1, _mm_unpackhi_epi64(both, reals));
  }

  static Real least(Real a, Real b) { return _mm_min_pd(a, b); }
  static Real greatest(Real a, Real b) { return _mm_max_pd(a, b); }
  static Real root(Real a) { return _mm_sqrt_pd(a); }
  static Real magnitude(Real a) { return _mm_andnot_pd(_mm_set1_pd(-0.0), a); }
  /// The nearest floats, as doubles.
  static Real to_float(Real x) { return _mm_cvtps_pd(_mm_cvtpd_ps(x)); }
  /// Largest integer <= x, for |x| < 2^51.
  static Real floor(Real x) {
    const Real shift = all(6755399441055744.0);  // 1.5 * 2^52: adding it rounds to an integer
    const Real nearest = (x + shift) - shift;
    return nearest - _mm_and_pd(_mm_cmplt_pd(x, nearest), all(1.0));
  }

  static Mask less(Real a, Real b) { return _mm_cmplt_pd(a, b); }
  static Mask less_equal(Real a, Real b) { return _mm_cmple_pd(a, b); }
  static Mask equal(Real a, Real b) { return _mm_cmpeq_pd(a, b); }
  static Mask both(Mask a, Mask b) { return _mm_and_pd(a, b); }
  static Mask either(Mask a, Mask b) { return _mm_or_pd(a, b); }
  static Mask without(Mask a, Mask b) { return _mm_andnot_pd(b, a); }
  static Mask same(Mask a, Mask b) {
    const Mask different = _mm_xor_pd(a, b);
    return _mm_xor_pd(different, _mm_castsi128_pd(_mm_set1_epi32(-1)));
  }
  static Real choose(Mask m, Real a, Real b) {
    return _mm_or_pd(_mm_and_pd(m, a), _mm_andnot_pd(m, b));
  }
  static unsigned bits(Mask m) { return static_cast<unsigned>(_mm_movemask_pd(m)); }
  static Mask mask(unsigned bits) {
    return _mm_castsi128_pd(_mm_set_epi64x(bits & 2u ? -1 : 0, bits & 1u ? -1 : 0));
  }

  /// The lanes of `m` get from[0], from[1], ... in order, the others keep x.
  static Real spread(Real x, Mask m, const double* from) {
    double lane[kCount];
    store(lane, x);
    for (unsigned left = bits(m); left; left &= left - 1) lane[__builtin_ctz(left)] = *from++;
    return load(lane);
  }

  /// Sixteen doubles, looked up by 2^52 + index.
  struct Table {
    const double* entries;
  };
  static Table table(const double* entries) { return {entries}; }
  static Real look_up(const Table& table, Real index) {
    const __m128i i = _mm_castpd_si128(index);
    return _mm_set_pd(table.entries[_mm_extract_epi16(i, 4)],
                      table.entries[_mm_extract_epi16(i, 0)]);
  }

  struct Pair {
    Real first, second;
  };
  /// The two floats at base + index * kStride, index an integer in [0, 2^31), for the lanes of `m`;
  /// 0 elsewhere.
  template <int kStride>
  static Pair gather(const float* base, Real index, Mask m) {
    double at[kCount];
    float first[kCount] = {}, second[kCount] = {};
    store(at, index);
    for (unsigned left = bits(m); left; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const float* pair = base + static_cast<std::int64_t>(at[lane]) * kStride;
      first[lane] = pair[0];
      second[lane] = pair[1];
    }
    return {_mm_set_pd(first[1], first[0]), _mm_set_pd(second[1], second[0])};
  }
  /// The same of whole numbers of 16 bits, each plus `more`.
  template <int kStride>
  static Pair gather(const std::uint16_t* base, Real index, Mask m, int more) {
    double at[kCount], first[kCount] = {}, second[kCount] = {};
    store(at, index);
    for (unsigned left = bits(m); left; left &= left - 1) {
      const int lane = __builtin_ctz(left);
      const std::uint16_t* pair = base + static_cast<std::int64_t>(at[lane]) * kStride;
      first[lane] = pair[0] + more;
      second[lane] = pair[1] + more;
    }
    return {load(first), load(second)};
  }
};

}  // namespace
}  // namespace plumb
