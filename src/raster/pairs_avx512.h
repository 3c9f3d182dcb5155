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
  static void gather(const ScreenVertex* vertices, const std::uint32_t* index, std::uint32_t count,
                     Pairs& a, Pairs& b, Pairs& c) {
    static_assert(sizeof(ScreenVertex) == 16);
    const auto some = [&](std::uint32_t most) {  // of the sixteen indices from `most` - 16 on
      const std::uint32_t left = 3 * count + 16 > most ? 3 * count + 16 - most : 0;
      return static_cast<__mmask16>(left < 16 ? (1u << left) - 1u : 0xffffu);
    };
    const __m512i first = _mm512_set1_epi32(static_cast<int>(index[0]));
    const __m512i low = _mm512_mask_loadu_epi32(first, some(16), index);
    const __m512i high = _mm512_mask_loadu_epi32(first, some(32), index + 16);
    const auto every_third = [&](int from) {
      const __m512i at =
          _mm512_add_epi32(_mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 0, 0, 0, 0, 0, 0, 0, 0),
                           _mm512_set1_epi32(from));
      const __m512i of = _mm512_permutex2var_epi32(low, at, high);
      const __m512i place = _mm512_cvtepu32_epi64(_mm512_castsi512_si256(of));
      return _mm512_i64gather_epi64(_mm512_slli_epi64(place, 1), vertices, 8);
    };
    a = every_third(0);
    b = every_third(1);
    c = every_third(2);
  }
  static Pairs least(Pairs a, Pairs b) { return _mm512_min_epi32(a, b); }
  static Pairs greatest(Pairs a, Pairs b) { return _mm512_max_epi32(a, b); }
  static Pairs sum(Pairs a, Pairs b) { return _mm512_add_epi32(a, b); }
  static Pairs difference(Pairs a, Pairs b) { return _mm512_sub_epi32(a, b); }
  static Pairs centre(Pairs pixel) {
    return _mm512_add_epi32(_mm512_slli_epi32(pixel, kSubpixelBits),
                            all(kSubpixels / 2, kSubpixels / 2));
  }
  static Pairs packed(Pairs a) { return halves(a, _mm512_srli_epi64(a, 16)); }
  static Pairs turned(Pairs a) {
    return halves(_mm512_srli_epi64(a, 32), _mm512_slli_epi32(_mm512_sub_epi32(all(0, 0), a), 16));
  }
  static Pairs halves(Pairs low, Pairs high) {
    return _mm512_or_si512(_mm512_and_si512(low, _mm512_set1_epi64(0xffff)),
                           _mm512_and_si512(high, _mm512_set1_epi64(0xffff0000)));
  }
  static Pairs products(Pairs a, Pairs b) { return _mm512_madd_epi16(a, b); }
  static Pairs both(Pairs a, Pairs b) { return _mm512_and_si512(a, b); }
  static Pairs pixel(Pairs a) { return _mm512_srai_epi32(a, kSubpixelBits); }
  static std::uint32_t bits_greater(Pairs a, Pairs b) { return _mm512_cmpgt_epi32_mask(a, b); }
  static std::uint32_t bits_equal(Pairs a, Pairs b) { return _mm512_cmpeq_epi32_mask(a, b); }
};

}  // namespace
}  // namespace plumb::raster
