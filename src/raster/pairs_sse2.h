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
  /// (x, y) of the vertices that every third index names, `count` of them; the rest are the first.
  static Pairs gather(const ScreenVertex* vertices, const std::uint32_t* index,
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
