// The paper's errors and factors, amid voids and at the terrain's edge, and what its mends add.
#include "mesh/tessellation/published_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mesh/tessellation/block_errors.h"
#include "mesh/tessellation/published_error.h"
#include "support/random_scene.h"

namespace plumb::mesh::tessellation {
namespace {

using patch_quadtree::layout_of;
using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;
using test_support::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

using Height = std::function<double(int, int)>;

// Of a block of 8 x 8 cells.
std::vector<double> block_heights(const Height& height) {
  std::vector<double> heights;
  for (int j = 0; j <= 8; ++j)
    for (int i = 0; i <= 8; ++i) heights.push_back(height(i, j));
  return heights;
}

BlockPlaces places_of(std::vector<int> columns, std::vector<int> rows) {
  return {std::move(columns), std::move(rows)};
}
const std::vector<int> kEven{0, 1, 2, 3, 4, 5, 6, 7, 8};
const BlockPieces kPieces(8);

Grid<float> field_of(int columns, int rows, const Height& height) {
  Grid<float> heights(columns, rows);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) heights(i, j) = static_cast<float>(height(i, j));
  return heights;
}

Prepared prepared_of(int columns, int rows, int patch_cells, const Height& height,
                     const Mends& mends = {}) {
  terrain::Heightfield field;
  field.heights_m = field_of(columns, rows, height);
  field.dx_m = field.dy_m = 10.0;
  return prepare(field, {.variant = Variant::Published,
                         .error_m = 0.001,
                         .patch_cells = patch_cells,
                         .mends = mends});
}

Mends only(Cause cause) {
  Mends mends{};
  mends[static_cast<std::size_t>(cause)] = true;
  return mends;
}

const Camera kDown = make_camera({.eye_m = {40, 40, 40},
                                  .target_m = {40, 40.001, 0},
                                  .fov_y_deg = 20.0,
                                  .width_px = 400,
                                  .height_px = 400});

PatchLevels levels_of_root(const Prepared& prepared, const ViewTest& view) {
  LevelCounts counts;
  const PatchPlace root = prepared.header().layout.root();
  const Grid<float> heights = patch_quadtree::heights_of(prepared.decoder->numbers(root),
                                                         prepared.header().quantiser, root.level);
  return published_levels(prepared, view, root, heights, counts);
}
ViewTest in_metres(double metres) { return {kDown, {metres, Unit::Metre}}; }

// The same pieces measured by what measures them against the finest heights.
double reference_error_m(const BlockLevels& levels, const BlockPlaces& places,
                         const std::vector<double>& heights) {
  std::vector<float> truth(heights.begin(), heights.end());
  double largest = 0.0;
  kPieces.for_each_piece(levels, [&](const std::vector<BlockTriangle>& triangles) {
    const double off = PieceGeometry(triangles, places).deviation(heights, {truth.data(), 9});
    largest = std::max(largest, off);
  });
  return largest;
}

BlockLevels random_levels(Random& random) {
  BlockLevels levels;
  levels.inside = static_cast<std::uint8_t>(random.integer(0, 3));
  for (std::uint8_t& side : levels.side) side = static_cast<std::uint8_t>(random.integer(0, 3));
  return levels;
}

std::vector<double> rough_block(Random& random) {
  return block_heights([&](int, int) { return static_cast<double>(random.integer(0, 64)); });
}

// A spike of 4 m on a sample that every thinning drops.
TEST(BlockGeometry, OfASpikeIsItsHeight) {
  const auto heights = block_heights([](int i, int j) { return i == 1 && j == 1 ? 4.0 : 0.0; });
  const BlockErrors errors = BlockGeometry(kPieces, places_of(kEven, kEven)).errors(heights);
  EXPECT_EQ(errors.printed_m, (std::vector<double>{0.0, 4.0, 4.0, 4.0}));
}

// Samples and crossings, of blocks within the terrain and of one that ends at its fifth column. Of
// heights of 64 m each rounds a few times by at most 64 * 1.1e-16.
TEST(BlockGeometry, MeasuresMixturesAsPiecesOverTheFinestHeightsAre) {
  Random random(1);
  for (const BlockPlaces& places :
       {places_of(kEven, kEven), places_of({0, 1, 2, 3, 4, 5, 5, 5, 5}, kEven)}) {
    const BlockGeometry geometry(kPieces, places);
    for (int k = 0; k < 100; ++k) {
      const std::vector<double> rough = rough_block(random);
      const auto heights = block_heights([&](int i, int j) {
        return rough[static_cast<std::size_t>(9 * j + places.column[static_cast<std::size_t>(i)])];
      });
      const BlockLevels levels = random_levels(random);
      EXPECT_NEAR(geometry.drawn_error_m(levels, heights),
                  reference_error_m(levels, places, heights), 1e-13);
    }
  }
}

// Columns 2 apart and the last cell 1 wide: h = max(0, x - 4) is linear between samples 0, 2 and 4
// where they stand, and would be half a metre off if the narrow cell counted as a whole one.
TEST(BlockGeometry, MeasuresWhereSamplesStand) {
  const std::vector<int> columns{0, 2, 4, 6, 7, 7, 7, 7, 7};
  const auto heights = block_heights(
      [&](int i, int) { return std::max(0.0, columns[static_cast<std::size_t>(i)] - 4.0); });
  const BlockGeometry geometry(kPieces, places_of(columns, {0, 2, 4, 6, 8, 10, 12, 14, 16}));
  EXPECT_NEAR(geometry.errors(heights).printed_m[1], 0.0, 1e-15);
  EXPECT_NEAR(geometry.errors(heights).mixed_m[1], 0.0, 1e-15);
  EXPECT_GT(geometry.errors(heights).printed_m[2], 1.0);
}

// Every mixture is within the largest of its own inside and sides; those of an inside of their own
// thinning do not say it of strips beside a finer inside.
TEST(BlockGeometry, CoversStripsCoarserThanTheInside) {
  Random random(2);
  const BlockGeometry geometry(kPieces, places_of(kEven, kEven));
  int beyond_mixed = 0;
  for (int k = 0; k < 400; ++k) {
    const std::vector<double> heights = rough_block(random);
    const BlockLevels levels = random_levels(random);
    const BlockErrors errors = geometry.errors(heights);
    double covered = errors.any_inside_m[levels.inside], mixed = errors.mixed_m[levels.inside];
    for (const std::uint8_t side : levels.side) {
      covered = std::max(covered, errors.any_inside_m[side]);
      mixed = std::max(mixed, errors.mixed_m[side]);
    }
    const double drawn = geometry.drawn_error_m(levels, heights);
    EXPECT_LE(drawn, covered);
    beyond_mixed += drawn > mixed;
  }
  EXPECT_GT(beyond_mixed, 0);
}

TEST(BlockGeometry, IsInfiniteWhereThinningMovesAVoidsOutline) {
  const BlockGeometry geometry(kPieces, places_of(kEven, kEven));
  const std::vector<double> never{0.0, kInfinity, kInfinity, kInfinity};
  // Dropped by every thinning: it would be covered. Kept by every one: what is about it would go.
  for (const int at : {1, 8}) {
    const auto heights =
        block_heights([&](int i, int j) { return i == at && j == at ? double{kVoid} : 0.0; });
    EXPECT_EQ(geometry.errors(heights).printed_m, never) << at;
    EXPECT_EQ(geometry.errors(heights).mixed_m, never) << at;
  }
  const auto nothing = block_heights([](int, int) { return double{kVoid}; });
  EXPECT_EQ(geometry.errors(nothing).printed_m, std::vector<double>(4, 0.0));
}

// Of a plane; at the edge a parent's last cell is 1 or 3 samples wide, not 2 or 4. In double the
// interpolation rounds by a few times 355 m * 1.1e-16.
TEST(PublishedErrors, OfAPlaneAreZeroAtTheTerrainsEdgeToo) {
  const PatchLayout layout = layout_of(72, 72, 32);
  for (const Height& plane :
       {Height([](int i, int) { return 5.0 * i; }), Height([](int, int j) { return 5.0 * j; })}) {
    for (const float error : published_errors(field_of(72, 72, plane), layout))
      EXPECT_LT(error, 1e-12);
  }
}

// A wall of 4 m on odd columns falls between the root's.
TEST(PublishedErrors, OfAWallThatDecimationDropsAreItsHeight) {
  const Grid<float> heights = field_of(17, 17, [](int i, int) { return i == 3 ? 4.0 : 0.0; });
  EXPECT_EQ(published_errors(heights, layout_of(17, 17, 8)).front(), 4.0f);
}

// The western column is void: thinned, the blocks along it would lose what lies beside it.
TEST(PublishedLevels, KeepWhatLiesBesideAVoidSide) {
  const Prepared prepared =
      prepared_of(17, 17, 16, [](int i, int) { return i == 0 ? double{kVoid} : 0.0; });
  const PatchLevels levels = levels_of_root(prepared, in_metres(1.0));
  for (int j = 0; j < 2; ++j) {
    EXPECT_EQ(levels.levels(0, j), (BlockLevels{0, {3, 0, 0, 0}}));
    EXPECT_EQ(levels.levels(1, j).inside, 3);  // of its most tolerant side, as printed
  }
}

TEST(PublishedLevels, KeepAnIslandWithinVoidSides) {
  const Height island = [](int i, int j) {
    return i >= 3 && i <= 5 && j >= 3 && j <= 5 ? 0.0 : double{kVoid};
  };
  EXPECT_EQ(levels_of_root(prepared_of(9, 9, 8, island), in_metres(1.0)).levels(0, 0).inside, 0);
}

// A spike in the western block leaves its sides fine, and the eastern block's other sides coarse.
TEST(PublishedLevels, ClaimWhatIsDrawnWithTheInsideMended) {
  const Height rough = [](int i, int j) {
    return i < 8 ? 10.0 * ((i * 7 + j * 5) % 3) : 0.1 * (i % 2);
  };
  const Prepared prepared = prepared_of(17, 9, 16, rough, only(Cause::InnerMinimum));
  const PatchLevels levels = levels_of_root(prepared, in_metres(1.0));
  const BlockLevels& east = levels.levels(1, 0);
  EXPECT_EQ(east.inside, 0);
  EXPECT_EQ(east.side[East], 3);
  const Grid<float> decoded = patch_quadtree::heights_of(prepared.decoder->numbers({0, 0, 0}),
                                                         prepared.header().quantiser, 0);
  const auto heights = block_heights([&](int i, int j) { return double{decoded(i + 9, j + 1)}; });
  const double drawn = reference_error_m(east, places_of(kEven, kEven), heights);
  EXPECT_GT(drawn, 0.01);
  EXPECT_NEAR(levels.bound_m(1, 0), drawn + prepared.header().quantiser.error_m(0), 1e-12);
}

TEST(PublishedLevels, ClaimThePapersLambdaAsPrinted) {
  const Prepared prepared =
      prepared_of(9, 9, 8, [](int i, int j) { return i == 1 && j == 1 ? 4.0 : 0.0; });
  const PatchLevels levels = levels_of_root(prepared, in_metres(5.0));
  EXPECT_EQ(levels.levels(0, 0), (BlockLevels{3, {3, 3, 3, 3}}));
  // The spike, coded within a millimetre, and that millimetre.
  EXPECT_NEAR(levels.bound_m(0, 0), 4.0, 0.0021);
}

// The camera sees a spike amid a block of 80 m, none of its sides.
TEST(PublishedLevels, WithTheMidpointMendedSeeWhatIsBesideASideOutOfView) {
  const Prepared prepared = prepared_of(
      9, 9, 8, [](int i, int j) { return i == 3 && j == 4 ? 5.0 : 0.0; },
      only(Cause::EdgeMidpoint));
  const PatchLevels levels = levels_of_root(prepared, {kDown, {1.0, Unit::Pixel}});
  EXPECT_EQ(levels.levels(0, 0), (BlockLevels{}));
}

// One test, of the root. As drawn, a cell of h = i j lies up to a quarter of its twist of 4 m off.
TEST(PublishedSelection, CountsWhatTheErrorAsDrawnWouldRefine) {
  const Prepared prepared = prepared_of(33, 33, 16, [](int i, int j) { return 1.0 * i * j; });
  const PatchSelection selection = select_patches(prepared, in_metres(0.5));
  EXPECT_EQ(selection.drawn.size(), 1u);
  EXPECT_EQ(selection.tested, 1);
  EXPECT_EQ(selection.finer_by_error, 1);
}

TEST(PublishedSelection, CountsNoPatchThatHasNoBoundAmidVoids) {
  const Prepared prepared =
      prepared_of(33, 33, 16, [](int i, int j) { return i == 5 && j == 5 ? double{kVoid} : 0.0; });
  const PatchSelection selection = select_patches(prepared, in_metres(0.5));
  EXPECT_EQ(selection.tested, 1);
  EXPECT_EQ(selection.finer_by_error, 0);
}

// Four patches of the finest level are drawn, and one is tested.
TEST(PublishedSelection, SaysOfHowManyTestsItSpeaks) {
  const Prepared prepared = prepared_of(33, 33, 16, [](int i, int) { return 100.0 * (i % 2); });
  const DrawnSurface drawn = draw(prepared, kDown, {0.5, Unit::Metre});
  EXPECT_TRUE(std::ranges::count(drawn.notes, "bilinear-error: 0 of 1 patches would be finer"));
}

}  // namespace
}  // namespace plumb::mesh::tessellation
