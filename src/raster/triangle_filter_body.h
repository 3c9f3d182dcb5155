// Written once for every number of triangles at a time; P offers pairs (x, y) of 32-bit integers.
// Included by one file for each instruction set, which call no inline function that others share.
#pragma once

#include "raster/triangle_filter.h"

namespace plumb::raster {
namespace {

// Triangles whose closed box holds this one centre, which lies beside them: of the edge functions
// there one is below zero and one above. Corners of such a triangle are less than a pixel away, so
// that 16 bits hold their coordinates from the centre. The bits of others mean nothing.
template <class P>
std::uint32_t beside_centre(typename P::Pairs centre, typename P::Pairs a, typename P::Pairs b,
                            typename P::Pairs c) {
  using Pairs = typename P::Pairs;
  const Pairs from_a = P::difference(a, centre), from_b = P::difference(b, centre);
  const Pairs from_c = P::difference(c, centre);
  const Pairs at_a = P::packed(from_a), at_b = P::packed(from_b), at_c = P::packed(from_c);
  const Pairs edge_a = P::products(at_b, P::turned(from_c));
  const Pairs edge_b = P::products(at_c, P::turned(from_a));
  const Pairs edge_c = P::products(at_a, P::turned(from_b));
  const Pairs zero = P::all(0, 0);
  return P::bits_greater(zero, P::least(P::least(edge_a, edge_b), edge_c)) &
         P::bits_greater(P::greatest(P::greatest(edge_a, edge_b), edge_c), zero);
}

inline bool all_below(const std::uint32_t* index, std::uint64_t count, std::uint64_t limit) {
  std::uint32_t largest = 0;
  for (std::uint64_t k = 0; k < count; ++k) largest = index[k] > largest ? index[k] : largest;
  return count == 0 || largest < limit;
}

template <class P>
std::uint32_t filter(const TriangleFilter& filter, const std::uint32_t* corners,
                     std::uint32_t count, std::uint32_t* kept) {
  using Pairs = typename P::Pairs;
  if (!all_below(corners, 3 * std::uint64_t{count}, filter.vertex_count)) return kBadIndex;
  const Pairs to_first = P::all(kSubpixels / 2 - 1, kSubpixels / 2 - 1);
  const Pairs to_last = P::all(-kSubpixels / 2, -kSubpixels / 2);
  const Pairs zero = P::all(0, 0), last_pixel = P::all(filter.last_column, filter.last_row);
  const Pairs clipped = P::all(filter.clipped, filter.clipped);
  std::uint32_t found = 0;
  for (std::uint32_t first = 0; first < count; first += P::kCount) {
    const std::uint32_t here = count - first < P::kCount ? count - first : P::kCount;
    const std::uint32_t* of = corners + 3 * std::uint64_t{first};
    Pairs a, b, c;
    P::gather(filter.vertices, of, here, a, b, c);
    const Pairs low = P::least(P::least(a, b), c), high = P::greatest(P::greatest(a, b), c);
    const Pairs first_pixel = P::pixel(P::sum(low, to_first));
    const Pairs end_pixel = P::pixel(P::sum(high, to_last));
    const Pairs begin = P::greatest(first_pixel, zero), end = P::least(end_pixel, last_pixel);
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
    if (keep) {
      const std::uint32_t one = P::bits_equal(first_pixel, end_pixel);
      keep &= ~(one & one >> 1 & beside_centre<P>(P::centre(first_pixel), a, b, c));
    }
    for (; keep; keep &= keep - 1)
      kept[found++] = first + static_cast<std::uint32_t>(__builtin_ctz(keep)) / 2;
  }
  return found;
}

}  // namespace
}  // namespace plumb::raster
