// How far pieces lie from the truth: by head, and against plain arithmetic.
#include "mesh/tessellation/piece_deviation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_scene.h"
#include "support/slow_deviation.h"

namespace plumb::mesh::tessellation {
namespace {

using terrain::Diagonal;
using test_support::DrawnTriangle;
using test_support::Random;
using test_support::SlowDeviation;

// Samples `step` apart; those beyond `last` are the last.
BlockPlaces places_every(int step, int cells = 8, int last = 1 << 20, int first = 0) {
  BlockPlaces places;
  for (int k = 0; k <= cells; ++k) places.column.push_back(std::min(first + k * step, last));
  places.row = places.column;
  return places;
}

// A terrain of 9 x 9 samples and a block over it whose heights are its own.
struct Ground {
  Grid<float> heights_m{9, 9};

  std::vector<double> drawn_m() const {
    return {heights_m.values().begin(), heights_m.values().end()};
  }
  TruthBelow truth() const { return {&heights_m(0, 0), 9}; }
};

// Crossings may lie at thirds: a dozen roundings of heights below 50.
TEST(PieceDeviation, OfAPlaneIsZero) {
  Ground ground;
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) ground.heights_m(i, j) = static_cast<float>(3 * i - 5 * j + 7);
  constexpr double kRounding = 12 * 50.0 * 1.2e-16;
  const BlockPieces pieces(8);
  for (int inside = 0; inside < 3; ++inside) {
    const auto off = [&](const std::vector<BlockTriangle>& piece) {
      return PieceGeometry(piece, places_every(1)).deviation(ground.drawn_m(), ground.truth());
    };
    EXPECT_LE(off(pieces.interior(inside)), kRounding);
    for (std::size_t side = 0; side < 4; ++side)
      for (int along = 0; along <= 3; ++along)
        EXPECT_LE(off(pieces.strip(inside, side, along)), kRounding);
    EXPECT_LE(off(pieces.whole()), kRounding);
  }
}

// Two triangles miss a sample of 5 m altogether; at full detail it is drawn.
TEST(PieceDeviation, OfOneRaisedSampleIsItsHeight) {
  Ground ground;
  ground.heights_m(3, 6) = 5.0f;
  const BlockPieces pieces(8);
  const auto off = [&](const std::vector<BlockTriangle>& piece) {
    return PieceGeometry(piece, places_every(1)).deviation(ground.drawn_m(), ground.truth());
  };
  EXPECT_EQ(off(pieces.whole()), 5.0);
  EXPECT_EQ(off(pieces.interior(0)), 0.0);
  EXPECT_EQ(off(pieces.interior(1)), 5.0);
  // It lies off the southern strip, so nothing that is drawn there sees it.
  EXPECT_EQ(off(pieces.strip(1, South, 1)), 0.0);
}

// The truth's diagonal rises from 0 to 0, the drawn one falls from 4 to 4: all four samples are
// drawn, and in the middle 4 stands over 0.
TEST(PieceDeviation, OfASaddleUnderADiagonalIsSeenAtTheCrossing) {
  Ground ground;
  ground.heights_m(1, 0) = ground.heights_m(0, 1) = 4.0f;
  const std::vector<BlockTriangle> falling{{BlockPoint{0, 0}, BlockPoint{1, 0}, BlockPoint{0, 1}},
                                           {BlockPoint{1, 0}, BlockPoint{1, 1}, BlockPoint{0, 1}}};
  const PieceGeometry piece(falling, places_every(1));
  EXPECT_EQ(piece.sample_deviation(ground.drawn_m(), ground.truth()), 0.0);
  EXPECT_EQ(piece.deviation(ground.drawn_m(), ground.truth()), 4.0);
  const std::vector<BlockTriangle> rising{{BlockPoint{0, 0}, BlockPoint{1, 0}, BlockPoint{1, 1}},
                                          {BlockPoint{0, 0}, BlockPoint{1, 1}, BlockPoint{0, 1}}};
  EXPECT_EQ(PieceGeometry(rising, places_every(1)).deviation(ground.drawn_m(), ground.truth()),
            0.0);
}

// Three columns of cells, the others beyond the terrain: whole, it is two triangles over 3 x 8
// cells, and sees nothing of heights that a wider block would.
TEST(PieceDeviation, OfABlockAtTheTerrainsBorderEndsThere) {
  Grid<float> heights_m(9, 9, 1000.0f);
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 4; ++i) heights_m(i, j) = 0.0f;
  heights_m(2, 1) = 7.0f;
  BlockPlaces places = places_every(1);
  for (int& column : places.column) column = std::min(column, 3);
  const std::vector<double> level(81, 0.0);
  const PieceGeometry whole(BlockPieces(8).whole(), places);
  EXPECT_EQ(whole.deviation(level, {&heights_m(0, 0), 9}), 7.0);
}

// A block somewhere in a rough terrain, thinned at random: places, drawn heights and triangles.
struct RandomBlock {
  Grid<float> terrain_m;
  BlockPlaces places;
  std::vector<double> drawn_m;
};

RandomBlock random_block(Random& random, int cells) {
  const int level = random.integer(0, 3), step = 1 << level;
  const bool clamped = random.chance(0.5);
  const int first_x = cells * step * random.integer(0, 1), first_y = cells * step;
  const auto size = [&](int first) {
    return first + 1 + (clamped ? random.integer(1, cells * step) : cells * step);
  };
  RandomBlock block{Grid<float>(size(first_x), size(first_y)), {}, {}};
  const double base = random.chance(0.5) ? 0.0 : random.uniform(-9e3, 9e3);
  for (float& height : block.terrain_m.values())
    height = static_cast<float>(base + random.uniform(-50.0, 50.0));
  for (int k = 0; k <= cells; ++k) {
    block.places.column.push_back(std::min(first_x + k * step, block.terrain_m.columns() - 1));
    block.places.row.push_back(std::min(first_y + k * step, block.terrain_m.rows() - 1));
  }
  // As decoded: a little off, the same where places are.
  const double off = random.chance(0.5) ? 0.0 : 1.0;
  for (const int row : block.places.row) {
    for (const int column : block.places.column)
      block.drawn_m.push_back(double{block.terrain_m(column, row)} +
                              off * ((column * 7 + row * 13) % 5 - 2));
  }
  return block;
}

std::vector<DrawnTriangle> triangles_of(const std::vector<BlockTriangle>& piece,
                                        const RandomBlock& block) {
  std::vector<DrawnTriangle> triangles;
  const std::size_t side = block.places.column.size();
  for (const BlockTriangle& t : piece) {
    DrawnTriangle corners{};
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = {block.places.column[t[k].i], block.places.row[t[k].j],
                    block.drawn_m[t[k].j * side + t[k].i]};
    triangles.push_back(corners);
  }
  return triangles;
}

// Both round a few times; 1e-12 of the heights is a thousand times that.
TEST(PieceDeviation, IsThatOfPlainArithmetic) {
  Random random(33);
  const BlockPieces blocks[] = {BlockPieces(8), BlockPieces(16)};
  for (int k = 0; k < 600; ++k) {
    const BlockPieces& pieces = blocks[k % 6 == 0];
    const RandomBlock block = random_block(random, pieces.block_cells());
    const SlowDeviation slow(block.terrain_m, Diagonal::Blocks8);
    const TruthBelow truth{&block.terrain_m(block.places.column.front(), block.places.row.front()),
                           block.terrain_m.columns()};
    double highest = 0.0;
    for (const double height : block.drawn_m) highest = std::max(highest, std::abs(height));
    const auto compare = [&](const std::vector<BlockTriangle>& piece) {
      EXPECT_NEAR(PieceGeometry(piece, block.places).deviation(block.drawn_m, truth),
                  slow.of(triangles_of(piece, block)), 1e-12 * highest)
          << k;
    };
    const auto level = [&](int most) { return static_cast<std::uint8_t>(random.integer(0, most)); };
    const int most = pieces.coarsest();
    pieces.for_each_piece({level(most), {level(most), level(most), level(most), level(most)}},
                          compare);
    compare(pieces.whole());
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace plumb::mesh::tessellation
