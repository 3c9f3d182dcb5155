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
  static Pairs gather(const ScreenVertex* vertices, const std::uint32_t* index,
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
