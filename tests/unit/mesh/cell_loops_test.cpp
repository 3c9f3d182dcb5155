// The loops of all 256 cells: what must hold of each, and the counts that the papers state.
#include "mesh/dual_contouring/cell_loops.h"

#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <set>
#include <vector>

namespace plumb::mesh::dual_contouring {
namespace {

bool is_inside(int mask, int corner) { return (mask >> corner & 1) != 0; }

bool crosses(int mask, int edge) {
  const int low = lower_corner(edge);
  return is_inside(mask, low) != is_inside(mask, low | 1 << (edge / 4));
}

// Edges of the face 2 * axis + side.
std::vector<int> edges_of_face(int face) {
  const int axis = face / 2;
  std::vector<int> edges;
  for (int e = 0; e < kCellEdges; ++e) {
    if (e / 4 != axis && (lower_corner(e) >> axis & 1) == face % 2) edges.push_back(e);
  }
  return edges;
}

std::vector<CellLoops> all_kinds(int m) {
  const auto mask = static_cast<CellMask>(m);
  return {single_loop(mask), manifold_loops(mask, false), manifold_loops(mask, true)};
}

// A cell turned about an axis, or mirrored: where each corner goes.
using Turn = std::array<int, 8>;

Turn turn(int axis_x, int axis_y, int axis_z, int flips) {
  Turn to{};
  for (int c = 0; c < 8; ++c) {
    const int moved = (c & 1) << axis_x | (c >> 1 & 1) << axis_y | (c >> 2) << axis_z;
    to[static_cast<std::size_t>(c)] = moved ^ flips;
  }
  return to;
}

std::vector<Turn> all_turns() {
  std::vector<Turn> turns;
  for (int flips = 0; flips < 8; ++flips) {
    for (const auto& [x, y, z] : {std::array{0, 1, 2}, std::array{1, 2, 0}, std::array{2, 0, 1},
                                  std::array{1, 0, 2}, std::array{0, 2, 1}, std::array{2, 1, 0}})
      turns.push_back(turn(x, y, z, flips));
  }
  return turns;
}

CellMask turned(const Turn& turn, int mask) {
  int result = 0;
  for (int c = 0; c < 8; ++c) result |= (mask >> c & 1) << turn[static_cast<std::size_t>(c)];
  return static_cast<CellMask>(result);
}

int turned_edge(const Turn& turn, int edge) {
  const int low = lower_corner(edge);
  const int a = turn[static_cast<std::size_t>(low)];
  const int b = turn[static_cast<std::size_t>(low | 1 << (edge / 4))];
  return edge_at(std::min(a, b), std::countr_zero(static_cast<unsigned>(a ^ b)));
}

std::set<unsigned> turned_loops(const Turn& turn, const CellLoops& loops) {
  std::set<unsigned> sets;
  for (int v = 0; v < loops.count; ++v) {
    unsigned edges = 0;
    for (int e = 0; e < kCellEdges; ++e) {
      if ((loops.edges[static_cast<std::size_t>(v)] >> e & 1) != 0)
        edges |= 1U << turned_edge(turn, e);
    }
    sets.insert(edges);
  }
  return sets;
}

const Turn kStill = turn(0, 1, 2, 0);

TEST(CellLoops, NamesEachEdgeByItsLowerCornerAndAxis) {
  EXPECT_EQ(lower_corner(0), 0);
  EXPECT_EQ(lower_corner(3), 6);   // along x at y = z = 1
  EXPECT_EQ(lower_corner(5), 4);   // along y at z = 1, x = 0
  EXPECT_EQ(lower_corner(11), 3);  // along z at x = y = 1
  for (int e = 0; e < kCellEdges; ++e) EXPECT_EQ(edge_at(lower_corner(e), e / 4), e);
}

TEST(CellLoops, PutEachCrossingEdgeInOneVertexAndNoOther) {
  for (int mask = 0; mask < 256; ++mask) {
    for (const CellLoops& loops : all_kinds(mask)) {
      for (int e = 0; e < kCellEdges; ++e) {
        const auto at = static_cast<std::size_t>(e);
        EXPECT_EQ(loops.of_edge[at] >= 0, crosses(mask, e));
        for (int v = 0; v < 4; ++v)
          EXPECT_EQ(loops.edges[static_cast<std::size_t>(v)] >> e & 1,
                    v == loops.of_edge[at] ? 1 : 0);
      }
    }
  }
}

TEST(CellLoops, AreAtMostFourInTheOrderOfTheirLowestEdges) {
  int most = 0;
  for (int mask = 0; mask < 256; ++mask) {
    for (const CellLoops& loops : all_kinds(mask)) {
      most = std::max(most, loops.count);
      for (int v = 1; v < loops.count; ++v)
        EXPECT_LT(std::countr_zero(loops.edges[static_cast<std::size_t>(v - 1)]),
                  std::countr_zero(loops.edges[static_cast<std::size_t>(v)]));
    }
  }
  EXPECT_EQ(most, 4);
}

TEST(CellLoops, AreOneForEachActiveCellWherePublished) {
  for (int mask = 0; mask < 256; ++mask)
    EXPECT_EQ(single_loop(static_cast<CellMask>(mask)).count, mask != 0 && mask != 255 ? 1 : 0);
}

// Each crossing edge lies on two faces: a loop enters a face as often as it leaves it.
TEST(CellLoops, AreClosed) {
  for (int mask = 0; mask < 256; ++mask) {
    for (const CellLoops& loops : all_kinds(mask)) {
      for (int face = 0; face < 6; ++face) {
        std::array<int, 4> ends{};
        for (const int e : edges_of_face(face)) {
          const int vertex = loops.of_edge[static_cast<std::size_t>(e)];
          if (vertex >= 0) ++ends[static_cast<std::size_t>(vertex)];
        }
        for (const int count : ends) EXPECT_EQ(count % 2, 0) << mask;
      }
    }
  }
}

// Two single corners, four of them, a diagonal pair seen from outside.
TEST(CellLoops, CutOffEachInsideCornerOfADiagonal) {
  EXPECT_EQ(manifold_loops(0b00001001).count, 2);
  EXPECT_EQ(manifold_loops(0b01101001).count, 4);
  EXPECT_EQ(manifold_loops(0b11110110).count, 1);
  EXPECT_EQ(manifold_loops(0b01111110).count, 2);  // empties on the space diagonal: 3 + 3
}

TEST(CellLoops, TurnWithTheCell) {
  for (const Turn& turn : all_turns()) {
    for (int m = 0; m < 256; ++m) {
      const auto mask = static_cast<CellMask>(m);
      for (const bool split : {false, true})
        EXPECT_EQ(turned_loops(turn, manifold_loops(mask, split)),
                  turned_loops(kStill, manifold_loops(turned(turn, m), split)));
    }
  }
}

// Without a diagonal on any face, nothing says which side is cut off. By corners inside: none, 8
// single ones, 12 edges and 4 space diagonals, 24 bent paths; 6 faces, 8 claws and 24 paths of
// four; and the complements: 2 * (1 + 8 + 16 + 24) + 38.
TEST(CellLoops, AreTheComplementsWhereNoFaceHasADiagonal) {
  int plain = 0;
  for (int m = 0; m < 256; ++m) {
    bool diagonal = false;
    for (int face = 0; face < 6; ++face) {
      int crossing = 0;
      for (const int e : edges_of_face(face)) crossing += crosses(m, e) ? 1 : 0;
      diagonal = diagonal || crossing == 4;
    }
    if (diagonal) continue;
    ++plain;
    EXPECT_EQ(turned_loops(kStill, manifold_loops(static_cast<CellMask>(m))),
              turned_loops(kStill, manifold_loops(static_cast<CellMask>(~m))));
  }
  EXPECT_EQ(plain, 136);
}

TEST(FaceToSplit, IsThereForThirtySixMasks) {
  std::map<int, int> by_inside;
  for (int m = 0; m < 256; ++m) {
    if (face_to_split(static_cast<CellMask>(m)) >= 0)
      ++by_inside[std::popcount(static_cast<unsigned>(m))];
  }
  EXPECT_EQ(by_inside, (std::map<int, int>{{5, 24}, {6, 12}}));
}

TEST(FaceToSplit, HasFourCrossingEdgesOfOneLoopAndSplittingGivesTwo) {
  for (int m = 0; m < 256; ++m) {
    const auto mask = static_cast<CellMask>(m);
    const int face = face_to_split(mask);
    if (face < 0) continue;
    const CellLoops &whole = manifold_loops(mask), &split = manifold_loops(mask, true);
    std::set<int> before, after;
    for (const int e : edges_of_face(face)) {
      EXPECT_TRUE(crosses(m, e));
      before.insert(whole.of_edge[static_cast<std::size_t>(e)]);
      after.insert(split.of_edge[static_cast<std::size_t>(e)]);
    }
    EXPECT_EQ(whole.count, 1);
    EXPECT_EQ(split.count, 2);
    EXPECT_EQ(before.size(), 1u);
    EXPECT_EQ(after.size(), 2u);
  }
}

TEST(FaceToSplit, ChangesNothingWhereThereIsNone) {
  for (int m = 0; m < 256; ++m) {
    const auto mask = static_cast<CellMask>(m);
    if (face_to_split(mask) >= 0) continue;
    EXPECT_EQ(manifold_loops(mask, true).edges, manifold_loops(mask, false).edges);
  }
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
