// The binary tree of right triangles over a square grid of 2^n + 1 samples a side, as pure
// geometry.
//
// A triangle (a, b, c) is counter-clockwise, c its right angle, m the midpoint of the hypotenuse
// ab: its base vertex. Its children are (c, a, m) and (b, c, m). A vertex is the base of two
// triangles, one on either side of the hypotenuse.
#pragma once

#include <array>
#include <bit>

namespace plumb::mesh::restricted_quadtree {

struct Corner {
  int i, j;
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct BinTriangle {
  Corner a, b, c;
  friend bool operator==(const BinTriangle&, const BinTriangle&) = default;
};

constexpr Corner base_vertex(const BinTriangle& t) {
  return {(t.a.i + t.b.i) / 2, (t.a.j + t.b.j) / 2};
}

/// True for the triangles that are half a cell: they have no base vertex among the samples.
constexpr bool is_finest(const BinTriangle& t) {
  const int across = t.a.i - t.b.i, up = t.a.j - t.b.j;
  return across * across + up * up <= 2;
}

/// In the order that the bit stream of [Intel sample 2012] is written in here: (c, a, m), then (b,
/// c, m).
constexpr std::array<BinTriangle, 2> children(const BinTriangle& t) {
  const Corner m = base_vertex(t);
  return {{{t.c, t.a, m}, {t.b, t.c, m}}};
}

/// The two halves of the square of `side` = 2^n cells whose south-west corner is (0, 0): (SW, NE,
/// NW), then (NE, SW, SE).
constexpr std::array<BinTriangle, 2> root_triangles(int side) {
  const Corner sw{0, 0}, se{side, 0}, nw{0, side}, ne{side, side};
  return {{{sw, ne, nw}, {ne, sw, se}}};
}

/// How far a vertex lies from the corners of the triangles that it is the base of: half the
/// hypotenuse along each axis. `half` is a power of two. (0, 0) and the other corners of the root
/// square are no base vertices.
struct BaseShape {
  int half;        // cells
  bool is_centre;  // hypotenuse along a square's diagonal; otherwise along a row or a column
  bool along_row;  // if not a centre: the hypotenuse runs east
  bool rises;      // if a centre: the hypotenuse runs from south-west to north-east
};

constexpr BaseShape base_shape(Corner v) {
  const int i_zeros = v.i == 0 ? 31 : std::countr_zero(static_cast<unsigned>(v.i));
  const int j_zeros = v.j == 0 ? 31 : std::countr_zero(static_cast<unsigned>(v.j));
  const int level = i_zeros < j_zeros ? i_zeros : j_zeros;
  BaseShape shape{1 << level, i_zeros == j_zeros, i_zeros < j_zeros, false};
  if (shape.is_centre) {
    // Ends of a diagonal have an even sum, in units of the square's side.
    const int across = (v.i - shape.half) >> (level + 1), up = (v.j - shape.half) >> (level + 1);
    shape.rises = ((across ^ up) & 1) == 0;
  }
  return shape;
}

/// The triangle with base vertex v on one side of its hypotenuse: side 1 has its right angle to the
/// north (or, level with v, to the east), side 0 to the south (west).
constexpr BinTriangle triangle_of_base(Corner v, int side) {
  const BaseShape s = base_shape(v);
  const int h = s.half;
  if (s.is_centre) {
    const Corner sw{v.i - h, v.j - h}, se{v.i + h, v.j - h}, nw{v.i - h, v.j + h},
        ne{v.i + h, v.j + h};
    if (s.rises) return side == 1 ? BinTriangle{sw, ne, nw} : BinTriangle{ne, sw, se};
    return side == 1 ? BinTriangle{nw, se, ne} : BinTriangle{se, nw, sw};
  }
  const Corner west{v.i - h, v.j}, east{v.i + h, v.j}, south{v.i, v.j - h}, north{v.i, v.j + h};
  if (s.along_row)
    return side == 1 ? BinTriangle{west, east, north} : BinTriangle{east, west, south};
  return side == 1 ? BinTriangle{north, south, east} : BinTriangle{south, north, west};
}

/// Which of its base vertex's two triangles this one is, numbered as in triangle_of_base.
constexpr int side_of_base(const BinTriangle& t) {
  const Corner m = base_vertex(t);
  return t.c.j > m.j || (t.c.j == m.j && t.c.i > m.i) ? 1 : 0;
}

/// Level in the binary tree counted from the finest, 0: each step doubles a triangle's area.
constexpr int level_above_finest(const BinTriangle& t) {
  const int across = t.a.i - t.b.i, up = t.a.j - t.b.j;
  const unsigned twice_area =
      static_cast<unsigned>((across * across + up * up) / 2);  // legs squared: 1, 2, 4, 8 ...
  return std::countr_zero(twice_area);
}

}  // namespace plumb::mesh::restricted_quadtree
