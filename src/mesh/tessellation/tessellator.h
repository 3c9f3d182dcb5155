// The fixed-function tessellator of Direct3D 11 and OpenGL on the CPU: the quad domain.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace plumb::mesh::tessellation {

/// How a factor becomes segments. Integer is OpenGL's `equal`; PowerOfTwo is Direct3D's alone.
enum class Spacing { Integer, PowerOfTwo, FractionalOdd, FractionalEven };

/// Factors of a patch, numbered as both interfaces do.
struct Factors {
  std::array<float, 4> outer;  // segments of the edges u = 0, v = 0, u = 1, v = 1
  std::array<float, 2> inner;  // segments of the inside along u and along v
};

/// A place in the unit square, in 1 / 65536: 0 to 65536, so that u * 0x1p-16f is exact.
struct DomainPoint {
  std::uint32_t u, v;
  bool operator==(const DomainPoint&) const = default;
};

/// The points of a patch, and three of their indices a triangle. With u to the east and v to the
/// north triangles run counter-clockwise (OpenGL's `ccw`). Fractional factors make some without
/// area, which are kept; those just above 6 and 30 in FractionalEven a few that run clockwise, by 7
/// units at most, since there the stage itself sets points beside the middle past it.
struct Tessellation {
  std::vector<DomainPoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Points and triangles of the quad domain, in the order in which the stage gives them.
///
/// factors  any floats: an outer one that is NaN or <= 0 culls the patch; all others are clamped to
///          [1, 64] (Integer, PowerOfTwo; then rounded up), [1, 63] (FractionalOdd) or [2, 64]
///          (FractionalEven), NaN to the lower bound
/// returns  at most 4,225 points and 8,192 triangles; none of either for a culled patch
///
///   (1) The points of an edge depend on the spacing and on that edge's factor alone, and lie
///       symmetrically: p(n - i) = 65536 - p(i). Patches that share an edge and its factor fit.
///   (2) The triangles cover the square: their areas add up to it, clockwise ones counted as
///       negative, and each edge within belongs to two triangles.
///   (3) Where a factor is a power of two, segments are 65536 / factor, exactly (Integer).
///   (4) Triangles off the rim depend on the inner factors alone.
/// Source: [Direct3D 11.3] and [OpenGL 4.5, section 11.2.2]; what they leave open (the place of odd
/// segments, diagonals, order) as [Reference tessellator] settles it, so that all is that of Mesa's
/// software driver, bit for bit. Hardware may differ in what is left open.
Tessellation tessellate(Spacing spacing, const Factors& factors);

/// The same, into vectors whose memory is used again.
void tessellate(Spacing spacing, const Factors& factors, Tessellation& reused);

}  // namespace plumb::mesh::tessellation
