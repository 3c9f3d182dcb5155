// The square as rings around each other, the rim first. A ring runs counter-clockwise from (0, 1):
// down u = 0, along v = 0, up u = 1, back along v = 1. Inner rings are those of the grid that the
// two inner subdivisions span; the last is a line of points, or a strip one segment wide.
#include "mesh/tessellation/tessellator.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "mesh/tessellation/subdivision.h"

namespace plumb::mesh::tessellation {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Points are numbered along rings, from the rim inwards.
struct Ring {
  std::uint32_t first;                    // the number of its first point
  std::array<std::uint32_t, 4> segments;  // of its sides
  // A line has two sides without segments; the way back along it has the points of the way there.
  bool is_line() const { return segments[0] == 0 || segments[1] == 0; }
  std::uint32_t points() const {
    if (is_line()) return segments[0] + segments[1] + 1;
    return segments[0] + segments[1] + segments[2] + segments[3];
  }
};

// The numbers of the points of a ring's side, both corners included.
struct Row {
  std::uint32_t segments;
  std::array<std::uint32_t, kMaxSegments + 1> point;
  std::uint32_t operator[](std::uint32_t i) const { return point[i]; }
};

Row side_of(const Ring& ring, std::size_t side) {
  Row row;
  row.segments = ring.segments[side];
  std::uint32_t start = 0;
  for (std::size_t k = 0; k < side; ++k) start += ring.segments[k];
  if (ring.is_line() && side >= 2) {
    start = ring.first + 2 * (ring.points() - 1) - start;
    for (std::uint32_t i = 0; i <= row.segments; ++i) row.point[i] = start - i;
    return row;
  }
  for (std::uint32_t i = 0; i <= row.segments; ++i) row.point[i] = ring.first + start + i;
  if (side == 3) row.point[row.segments] = ring.first;
  return row;
}

// ---- points

// A side of the ring that lies `depth` segments within, without the last corner.
DomainPoint* place_side(std::size_t side, const Subdivision& along, std::uint32_t across,
                        std::uint32_t depth, DomainPoint* out) {
  const std::uint32_t n = along.segments;
  for (std::uint32_t i = depth; i < n - depth; ++i) {
    const std::uint32_t place = along.place[side == 0 || side == 3 ? n - i : i];
    *out++ = side % 2 == 0 ? DomainPoint{across, place} : DomainPoint{place, across};
  }
  return out;
}

DomainPoint* place_rim(const std::array<Subdivision, 4>& sides, DomainPoint* out) {
  for (std::size_t k = 0; k < 4; ++k) out = place_side(k, sides[k], k < 2 ? 0 : kOne, 0, out);
  return out;
}

DomainPoint* place_ring(const Subdivision& u, const Subdivision& v, const Ring& ring,
                        std::uint32_t depth, DomainPoint* out) {
  const std::uint32_t u_far = u.place[u.segments - depth], v_near = v.place[depth];
  out = place_side(0, v, u.place[depth], depth, out);
  out = place_side(1, u, v_near, depth, out);
  if (ring.is_line()) {
    *out++ = {u_far, v_near};
    return out;
  }
  out = place_side(2, v, u_far, depth, out);
  return place_side(3, u, v.place[v.segments - depth], depth, out);
}

// ---- triangles

// The finest half of a side has 32 segments, and position p is where the p-th ends; position 0 is
// the corner. Half a side of n segments has those whose rank is below n / 2. Ranks go by bit
// reversal, so that a finer side has the segments of the coarser ones and one more.
constexpr std::uint64_t kCorner = 1;
constexpr std::array<std::uint64_t, kMaxSegments / 2 + 1> kPassed = [] {
  std::array<std::uint64_t, kMaxSegments / 2 + 1> passed{};  // by n / 2: positions as bits
  for (unsigned position = 0; position <= 32; ++position) {
    unsigned rank = position == 0 ? 0 : 32;
    if (position > 1) {
      const int zeros = std::countr_zero(position - 1);
      rank = (16u >> zeros) + ((position - 1) >> (zeros + 1));
    }
    for (unsigned half = rank + 1; half < passed.size(); ++half)
      passed[half] |= std::uint64_t{1} << position;
  }
  return passed;
}();

// The strip between a side of the rim and that of the first ring, whatever their segments: both
// are walked at once, and each step adds a triangle on the side that takes it.
Triangle* join_rim(const Row& outer, const Row& inner, Triangle* out) {
  const std::uint64_t of_outer = kPassed[outer.segments / 2];
  const std::uint64_t of_inner = kPassed[inner.segments / 2 + 1] & ~kCorner;
  std::uint32_t o = 0, i = 0;
  const auto step_inside = [&] {
    *out++ = {inner[i], outer[o], inner[i + 1]};
    ++i;
  };
  const auto step_outside = [&] {
    *out++ = {outer[o], outer[o + 1], inner[i]};
    ++o;
  };
  for (std::uint64_t left = of_outer | of_inner; left != 0; left &= left - 1) {
    const std::uint64_t nearest = left & (~left + 1);
    if (of_inner & nearest) step_inside();
    if (of_outer & nearest) step_outside();
  }
  if (inner.segments % 2 == 1) step_inside();
  if (outer.segments % 2 == 1) {
    *out++ = {inner[i], outer[o], outer[o + 1]};
    ++o;
  }
  for (std::uint64_t left = of_outer | of_inner; left != 0;) {
    const std::uint64_t farthest = std::bit_floor(left);
    if (of_outer & farthest) step_outside();
    if (of_inner & farthest) step_inside();
    left ^= farthest;
  }
  return out;
}

// The strip between two rings of the grid: squares whose diagonals lean to the middle.
Triangle* join_rings(const Row& outer, const Row& inner, Triangle* out) {
  const std::uint32_t n = inner.segments;
  *out++ = {outer[0], outer[1], inner[0]};
  std::uint32_t i = 0;
  for (; i < (n + 1) / 2; ++i) {
    *out++ = {outer[i + 1], inner[i + 1], inner[i]};
    *out++ = {outer[i + 1], outer[i + 2], inner[i + 1]};
  }
  for (; i < n; ++i) {
    *out++ = {inner[i], outer[i + 1], outer[i + 2]};
    *out++ = {inner[i], outer[i + 2], inner[i + 1]};
  }
  *out++ = {outer[n + 1], outer[n + 2], inner[n]};
  return out;
}

// The inside of the last ring where that is a strip one segment wide, along v if it is square.
// Diagonals lean one way, but for the middle one of an odd number of squares along v.
Triangle* fill_strip(const Ring& ring, Triangle* out) {
  const bool along_v = ring.segments[0] >= ring.segments[1];
  const Row right = side_of(ring, along_v ? 0 : 1), left = side_of(ring, along_v ? 2 : 3);
  const std::uint32_t n = right.segments;
  const bool odd_along_v = along_v && n % 2 == 1;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = left[n - i], b = right[i], c = right[i + 1], d = left[n - i - 1];
    const bool turned = odd_along_v && i == n / 2;
    *out++ = turned ? Triangle{b, d, a} : odd_along_v ? Triangle{b, c, a} : Triangle{a, b, c};
    *out++ = turned ? Triangle{b, c, d} : Triangle{a, c, d};
  }
  return out;
}

void fill(const std::array<Subdivision, 4>& rim, const Subdivision& u, const Subdivision& v,
          Tessellation& result) {
  Ring outer{0, {rim[0].segments, rim[1].segments, rim[2].segments, rim[3].segments}};
  const std::uint32_t inside = (u.segments - 1) * (v.segments - 1);
  result.points.resize(outer.points() + inside);
  result.triangles.resize(outer.points() + 2 * inside - 2);  // Euler's formula
  DomainPoint* point = place_rim(rim, result.points.data());
  Triangle* triangle = result.triangles.data();
  for (std::uint32_t depth = 1; 2 * depth <= std::min(u.segments, v.segments); ++depth) {
    const std::uint32_t nu = u.segments - 2 * depth, nv = v.segments - 2 * depth;
    const Ring inner{outer.first + outer.points(), {nv, nu, nv, nu}};
    point = place_ring(u, v, inner, depth, point);
    for (std::size_t k = 0; k < 4; ++k) {
      triangle =
          (depth == 1 ? join_rim : join_rings)(side_of(outer, k), side_of(inner, k), triangle);
    }
    outer = inner;
  }
  if (!outer.is_line()) triangle = fill_strip(outer, triangle);
  assert(point == result.points.data() + result.points.size());
  assert(triangle == result.triangles.data() + result.triangles.size());
}

}  // namespace

void tessellate(Spacing spacing, const Factors& factors, Tessellation& reused) {
  const std::optional<Levels> levels = levels_of(spacing, factors);
  if (!levels) {
    reused.points.clear();
    reused.triangles.clear();
  } else if (levels->undivided) {
    reused.points.assign({{0, 0}, {kOne, 0}, {kOne, kOne}, {0, kOne}});
    reused.triangles.assign({{0, 1, 3}, {1, 2, 3}});
  } else {
    const auto& [west, south, east, north] = levels->outer;
    fill({subdivide(west), subdivide(south), subdivide(east), subdivide(north)},
         subdivide(levels->inner[0]), subdivide(levels->inner[1]), reused);
  }
}

Tessellation tessellate(Spacing spacing, const Factors& factors) {
  Tessellation result;
  tessellate(spacing, factors, result);
  return result;
}

}  // namespace plumb::mesh::tessellation
