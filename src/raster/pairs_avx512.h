// Eight triangles' corners at a time. For files that are compiled for AVX-512 and included nowhere
// else.
#pragma once

#include <immintrin.h>

#include <cstdint>

#include "raster/fixed_point.h"

namespace plumb::raster {
namespace {

/// As Sse2Pairs.
struct Avx512Pairs {
  static constexpr std::uint32_t kCount = 8;
  static constexpr std::uint32_t kFirst = 0x5555;
  using Pairs = __m512i;

  static Pairs all(std::int32_t x, std::int32_t y) {
    return _mm512_set1_epi64(static_cast<std::int64_t>(
        std::uint64_t{static_cast<std::uint32_t>(y)} << 32 | static_cast<std::uint32_t>(x)));
  }
  static Pairs gather(const ScreenVertex* vertices, const std::uint32_t* index,
                      std::uint32_t count) {
    static_assert(sizeof(ScreenVertex) == 16);
    const __m256i every_third = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
    const auto some = static_cast<__mmask8>((1u << count) - 1u);
    const __m256i first = _mm256_set1_epi32(static_cast<int>(index[0]));
    const __m256i of = _mm256_mmask_i32gather_epi32(first, some, every_third, index, 4);
    const __m512i doubled = _mm512_slli_epi64(_mm512_cvtepu32_epi64(of), 1);
    return _mm512_i64gather_epi64(doubled, vertices, 8);
  }
  static Pairs least(Pairs a, Pairs b) { return _mm512_min_epi32(a, b); }
  static Pairs greatest(Pairs a, Pairs b) { return _mm512_max_epi32(a, b); }
  static Pairs sum(Pairs a, Pairs b) { return _mm512_add_epi32(a, b); }
  static Pairs both(Pairs a, Pairs b) { return _mm512_and_si512(a, b); }
  static Pairs pixel(Pairs a) { return _mm512_srai_epi32(a, kSubpixelBits); }
  static std::uint32_t bits_greater(Pairs a, Pairs b) { return _mm512_cmpgt_epi32_mask(a, b); }
  static std::uint32_t bits_equal(Pairs a, Pairs b) { return _mm512_cmpeq_epi32_mask(a, b); }
};

}  // namespace
}  // namespace plumb::raster
