// Throws out most triangles of a dense mesh: those that cover no pixel's centre.
#pragma once

#include <cstdint>

#include "core/instruction_set.h"
#include "raster/fixed_point.h"

namespace plumb::raster {

inline constexpr std::uint32_t kBadIndex = 0xffffffff;

struct TriangleFilter {
  const ScreenVertex* vertices;
  std::uint64_t vertex_count;
  std::int32_t clipped;                // x of a vertex that must be clipped; its y: by which planes
  std::int32_t last_column, last_row;  // of the window's pixels, which begin at 0
};

/// Of `count` triangles (three indices each) the numbers of those that may cover a pixel's centre
/// or must be clipped go to `kept`, in order. Returns how many; `kept` has room for all, and eight
/// more. kBadIndex if a triangle names a vertex that is not there.
///
/// Left out are exactly the triangles whose corners are all cut off by one and the same plane, and,
/// of those with no corner cut off, the ones whose pixel_box(...) is empty within the window or is
/// one pixel whose centre lies outside the closed triangle.
using FilterTriangles = std::uint32_t (*)(const TriangleFilter&, const std::uint32_t* corners,
                                          std::uint32_t count, std::uint32_t* kept);

FilterTriangles filter_triangles(InstructionSet set);

}  // namespace plumb::raster
