// Four triangles' corners at a time. For files that are compiled for AVX2 and included nowhere
// else.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "raster/fixed_point.h"

namespace plumb::raster {
namespace {

/// As Sse2Pairs.
struct Avx2Pairs {
  static constexpr std::uint32_t kCount = 4;
  static constexpr std::uint32_t kFirst = 0x55;
  using Pairs = __m256i;

  static Pairs all(std::int32_t x, std::int32_t y) {
    return _mm256_setr_epi32(x, y, x, y, x, y, x, y);
  }
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
    return _mm256_set_m128i(_mm_unpacklo_epi64(at(2), at(3)), _mm_unpacklo_epi64(at(0), at(1)));
  }
  static Pairs least(Pairs a, Pairs b) { return _mm256_min_epi32(a, b); }
  static Pairs greatest(Pairs a, Pairs b) { return _mm256_max_epi32(a, b); }
  static Pairs sum(Pairs a, Pairs b) { return _mm256_add_epi32(a, b); }
  static Pairs difference(Pairs a, Pairs b) { return _mm256_sub_epi32(a, b); }
  static Pairs centre(Pairs pixel) {
    return _mm256_add_epi32(_mm256_slli_epi32(pixel, kSubpixelBits),
                            all(kSubpixels / 2, kSubpixels / 2));
  }
  static Pairs packed(Pairs a) { return halves(a, _mm256_srli_epi64(a, 16)); }
  static Pairs turned(Pairs a) {
    return halves(_mm256_srli_epi64(a, 32), _mm256_slli_epi32(_mm256_sub_epi32(all(0, 0), a), 16));
  }
  static Pairs halves(Pairs low, Pairs high) {
    return _mm256_or_si256(_mm256_and_si256(low, _mm256_set1_epi64x(0xffff)),
                           _mm256_and_si256(high, _mm256_set1_epi64x(0xffff0000)));
  }
  static Pairs products(Pairs a, Pairs b) { return _mm256_madd_epi16(a, b); }
  static Pairs both(Pairs a, Pairs b) { return _mm256_and_si256(a, b); }
  static Pairs pixel(Pairs a) { return _mm256_srai_epi32(a, kSubpixelBits); }
  static std::uint32_t bits(__m256i mask) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(mask)));
  }
  static std::uint32_t bits_greater(Pairs a, Pairs b) { return bits(_mm256_cmpgt_epi32(a, b)); }
  static std::uint32_t bits_equal(Pairs a, Pairs b) { return bits(_mm256_cmpeq_epi32(a, b)); }
};

}  // namespace
}  // namespace plumb::raster
