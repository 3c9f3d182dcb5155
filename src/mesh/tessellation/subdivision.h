// One dimension of the tessellator: what a factor means, and where it puts the points of a side.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mesh/tessellation/tessellator.h"

namespace plumb::mesh::tessellation {

inline constexpr std::uint32_t kOne = 1u << 16;  // the side of the domain, and a factor of 1
inline constexpr std::uint32_t kMaxSegments = 64;

/// A factor that needs no further rule.
struct Level {
  std::uint32_t factor;  // in 1 / 65536: kOne to 64 * kOne
  bool odd;              // whether it gives an odd number of segments
};

struct Levels {
  std::array<Level, 4> outer;
  std::array<Level, 2> inner;
  bool undivided;  // all are one: the square is two triangles. Otherwise the inner ones exceed one
};

/// Clamped, rounded factors; none for a patch that is culled.
std::optional<Levels> levels_of(Spacing spacing, const Factors& factors);

/// A side of the domain cut into segments.
struct Subdivision {
  std::uint32_t segments;                             // 1 to kMaxSegments
  std::array<std::uint32_t, kMaxSegments + 1> place;  // [0, segments], from 0 to kOne
};

/// Where the points of a side lie.
///
///   (1) place[segments - i] = kOne - place[i], and the middle of an even number is kOne / 2.
///   (2) Segments are equal to within the rounding of their reciprocal, but for one in each half
///       that grows as a fractional factor does.
///   (3) Places never fall, but beside the middle of an even side whose factor exceeds 6 or 30 by
///       less than 0.0075: there the rounding adds up to 1 and 7 units, the new segment has no
///       length yet, and it runs back by as much.
Subdivision subdivide(Level level);

}  // namespace plumb::mesh::tessellation
