// Written once for every number of triangles at a time; P offers pairs (x, y) of 32-bit integers.
// Included by one file for each instruction set, which call no inline function that others share.
#pragma once

#include "raster/triangle_filter.h"

namespace plumb::raster {
namespace {

template <class P>
std::uint32_t filter(const TriangleFilter& filter, const std::uint32_t* corners,
                     std::uint32_t count, std::uint32_t* kept) {
  using Pairs = typename P::Pairs;
  const Pairs to_first = P::all(kSubpixels / 2 - 1, kSubpixels / 2 - 1);
  const Pairs to_last = P::all(-kSubpixels / 2, -kSubpixels / 2);
  const Pairs zero = P::all(0, 0), last_pixel = P::all(filter.last_column, filter.last_row);
  const Pairs clipped = P::all(filter.clipped, filter.clipped);
  std::uint32_t found = 0;
  for (std::uint32_t first = 0; first < count; first += P::kCount) {
    const std::uint32_t here = count - first < P::kCount ? count - first : P::kCount;
    const std::uint32_t* of = corners + 3 * std::uint64_t{first};
    const Pairs a = P::gather(filter.vertices, of, here);
    const Pairs b = P::gather(filter.vertices, of + 1, here);
    const Pairs c = P::gather(filter.vertices, of + 2, here);
    const Pairs low = P::least(P::least(a, b), c), high = P::greatest(P::greatest(a, b), c);
    const Pairs begin = P::greatest(P::pixel(P::sum(low, to_first)), zero);
    const Pairs end = P::least(P::pixel(P::sum(high, to_last)), last_pixel);
    // Bits of a triangle: one for x, one for y.
    const std::uint32_t empty = P::bits_greater(begin, end);
    const std::uint32_t some_cut = P::bits_equal(low, clipped) & P::kFirst;
    std::uint32_t keep = ~(empty | empty >> 1) & P::kFirst;
    if (some_cut) {
      const std::uint32_t all_cut = P::bits_equal(high, clipped) & P::kFirst;
      // The y of three cut corners: a plane in common?
      const Pairs common = P::both(P::both(a, b), c);
      const std::uint32_t in_common = ~P::bits_equal(common, zero) >> 1 & P::kFirst;
      keep = (keep & ~some_cut) | (some_cut & ~(all_cut & in_common));
    }
    keep &= here < P::kCount ? (1u << (2 * here)) - 1u : 0xffffffffu;
    for (; keep; keep &= keep - 1)
      kept[found++] = first + static_cast<std::uint32_t>(__builtin_ctz(keep)) / 2;
  }
  return found;
}

}  // namespace
}  // namespace plumb::raster
