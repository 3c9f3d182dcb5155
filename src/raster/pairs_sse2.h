// Pairs of 32-bit integers, two triangles' corners at a time.
#pragma once

#include <emmintrin.h>

#include <cstdint>

#include "raster/fixed_point.h"

namespace plumb::raster {
namespace {

/// pairs_avx2.h and pairs_avx512.h offer the same names.
struct Sse2Pairs {
  static constexpr std::uint32_t kCount = 2;
  static constexpr std::uint32_t kFirst = 0x5;  // the bits of x
  using Pairs = __m128i;

  static Pairs all(std::int32_t x, std::int32_t y) { return _mm_setr_epi32(x, y, x, y); }
  /// (x, y) of the three corners of `count` triangles, at most kCount; what else stands in the
  /// pairs is some vertex of the first triangle or zero.
  static void gather(const ScreenVertex* vertices, const std::uint32_t* index, std::uint32_t count,
                     Pairs& a, Pairs& b, Pairs& c) {
    a = every_third(vertices, index, count);
    b = every_third(vertices, index + 1, count);
    c = every_third(vertices, index + 2, count);
  }
  static Pairs every_third(const ScreenVertex* vertices, const std::uint32_t* index,
                           std::uint32_t count) {
    const auto at = [&](std::uint32_t k) {
      return _mm_loadl_epi64(
          reinterpret_cast<const __m128i*>(&vertices[index[k < count ? 3 * k : 0]]));
    };
    return _mm_unpacklo_epi64(at(0), at(1));
  }
  static Pairs choose(__m128i mask, Pairs a, Pairs b) {
    return _mm_or_si128(_mm_and_si128(mask, a), _mm_andnot_si128(mask, b));
  }
  static Pairs least(Pairs a, Pairs b) { return choose(_mm_cmplt_epi32(a, b), a, b); }
  static Pairs greatest(Pairs a, Pairs b) { return choose(_mm_cmpgt_epi32(a, b), a, b); }
  static Pairs sum(Pairs a, Pairs b) { return _mm_add_epi32(a, b); }
  static Pairs difference(Pairs a, Pairs b) { return _mm_sub_epi32(a, b); }
  /// The centre of a pixel, in subpixels.
  static Pairs centre(Pairs pixel) {
    return _mm_add_epi32(_mm_slli_epi32(pixel, kSubpixelBits), all(kSubpixels / 2, kSubpixels / 2));
  }
  /// Of (x, y), both of 16 bits: x and y, or y and -x, beside each other in the first 32 bits; and
  /// the sum of the two products there, so that products(packed(a), turned(b)) is their cross
  /// product.
  static Pairs packed(Pairs a) { return halves(a, _mm_srli_epi64(a, 16)); }
  static Pairs turned(Pairs a) {
    return halves(_mm_srli_epi64(a, 32), _mm_slli_epi32(_mm_sub_epi32(all(0, 0), a), 16));
  }
  static Pairs halves(Pairs low, Pairs high) {
    return _mm_or_si128(_mm_and_si128(low, _mm_set1_epi64x(0xffff)),
                        _mm_and_si128(high, _mm_set1_epi64x(0xffff0000)));
  }
  static Pairs products(Pairs a, Pairs b) { return _mm_madd_epi16(a, b); }
  static Pairs both(Pairs a, Pairs b) { return _mm_and_si128(a, b); }
  static Pairs pixel(Pairs a) { return _mm_srai_epi32(a, kSubpixelBits); }
  static std::uint32_t bits(__m128i mask) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(mask)));
  }
  static std::uint32_t bits_greater(Pairs a, Pairs b) { return bits(_mm_cmpgt_epi32(a, b)); }
  static std::uint32_t bits_equal(Pairs a, Pairs b) { return bits(_mm_cmpeq_epi32(a, b)); }
};

}  // namespace
}  // namespace plumb::raster
