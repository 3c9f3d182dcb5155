#include "mesh/dual_contouring/cell_loops.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr int kMasks = 256;

// A face of the cell: its corners in the order round it, and after each corner the edge to the
// next.
struct Face {
  std::array<int, 4> corner{}, edge{};
};

// 2 * axis + side.
Face face_of(int number) {
  const int axis = number / 2;
  const int base = (number % 2) << axis;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  const int a1 = base | 1 << a, b1 = base | 1 << b;
  return {{base, a1, a1 | b1, b1},
          {edge_at(base, a), edge_at(a1, b), edge_at(b1, a), edge_at(base, b)}};
}

// The curves on a face, each by the two edges that it ends on.
struct Curves {
  int count = 0;
  std::array<std::array<int, 2>, 2> ends{};
};

// Curves that cut off the runs of corners that are inside (or, if so said, outside).
Curves curves_on(const Face& face, CellMask mask, bool cut_off_inside) {
  Curves curves;
  const auto cut_off = [&](int k) {
    return ((mask >> face.corner[static_cast<std::size_t>(k % 4)] & 1) != 0) == cut_off_inside;
  };
  for (int k = 0; k < 4; ++k) {
    if (cut_off(k) || !cut_off(k + 1)) continue;  // a run begins after corner k
    int last = k + 1;
    while (cut_off(last + 1)) ++last;
    curves.ends[static_cast<std::size_t>(curves.count++)] = {
        face.edge[static_cast<std::size_t>(k)], face.edge[static_cast<std::size_t>(last % 4)]};
  }
  return curves;
}

std::uint16_t crossing_edges(CellMask mask) {
  unsigned edges = 0;
  for (int e = 0; e < kCellEdges; ++e) {
    const int low = lower_corner(e), high = low | 1 << (e / 4);
    edges |= static_cast<unsigned>((mask >> low ^ mask >> high) & 1) << e;
  }
  return static_cast<std::uint16_t>(edges);
}

// Vertices from the edges that belong together: set[e] is the set that edge e is in.
CellLoops loops_of(std::uint16_t crossing, const std::array<std::uint16_t, kCellEdges>& together) {
  CellLoops loops;
  loops.of_edge.fill(-1);
  for (std::size_t e = 0; e < kCellEdges; ++e) {
    if ((crossing >> e & 1) == 0 || loops.of_edge[e] >= 0) continue;
    const std::uint16_t edges = together[e];
    for (std::size_t other = 0; other < kCellEdges; ++other) {
      if ((edges >> other & 1) != 0) loops.of_edge[other] = static_cast<std::int8_t>(loops.count);
    }
    loops.edges[static_cast<std::size_t>(loops.count++)] = edges;
  }
  return loops;
}

// Joins the crossing edges by the curves of all faces; on the face `split` they cut off its
// outside.
CellLoops joined(CellMask mask, int split) {
  std::array<std::uint16_t, kCellEdges> together{};
  for (std::size_t e = 0; e < kCellEdges; ++e) together[e] = static_cast<std::uint16_t>(1U << e);
  for (int f = 0; f < 6; ++f) {
    const Curves curves = curves_on(face_of(f), mask, f != split);
    for (int c = 0; c < curves.count; ++c) {
      const auto& [first, second] = curves.ends[static_cast<std::size_t>(c)];
      const auto both = static_cast<std::uint16_t>(together[static_cast<std::size_t>(first)] |
                                                   together[static_cast<std::size_t>(second)]);
      for (std::size_t e = 0; e < kCellEdges; ++e) {
        if ((both >> e & 1) != 0) together[e] = both;
      }
    }
  }
  return loops_of(crossing_edges(mask), together);
}

int face_of_one_loop_twice(CellMask mask, const CellLoops& loops) {
  for (int f = 0; f < 6; ++f) {
    const Curves curves = curves_on(face_of(f), mask, true);
    const auto loop_of = [&](std::size_t c) {
      return loops.of_edge[static_cast<std::size_t>(curves.ends[c][0])];
    };
    if (curves.count == 2 && loop_of(0) == loop_of(1)) return f;
  }
  return -1;
}

struct Tables {
  std::array<CellLoops, kMasks> single, whole, split;
  std::array<int, kMasks> face{};

  Tables() {
    for (std::size_t m = 0; m < kMasks; ++m) {
      const auto mask = static_cast<CellMask>(m);
      std::array<std::uint16_t, kCellEdges> all{};
      all.fill(crossing_edges(mask));
      single[m] = loops_of(crossing_edges(mask), all);
      whole[m] = joined(mask, -1);
      face[m] = face_of_one_loop_twice(mask, whole[m]);
      split[m] = joined(mask, face[m]);
    }
  }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

}  // namespace

const CellLoops& single_loop(CellMask mask) { return tables().single[mask]; }

const CellLoops& manifold_loops(CellMask mask, bool split) {
  return split ? tables().split[mask] : tables().whole[mask];
}

int face_to_split(CellMask mask) { return tables().face[mask]; }

}  // namespace plumb::mesh::dual_contouring
