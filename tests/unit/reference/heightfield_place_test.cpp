// The truth at a place, and the nearest truth to a point.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/heightfield_nearest.h"
#include "reference/surface_height.h"
#include "support/test_terrain.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;

terrain::Heightfield cell(float sw, float se, float nw, float ne) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(2, 2);
  field.heights_m.floats()(0, 0) = sw;
  field.heights_m.floats()(1, 0) = se;
  field.heights_m.floats()(0, 1) = nw;
  field.heights_m.floats()(1, 1) = ne;
  field.dx_m = 10.0;
  field.dy_m = 20.0;
  return field;
}

TEST(SurfaceAt, TellsTheTwoDiagonalsApart) {
  const terrain::Heightfield saddle = cell(0, 8, 8, 0);
  // The middle lies on the diagonal: between SW and NE at 0, between SE and NW at 8.
  EXPECT_EQ(surface_at(saddle, Diagonal::Alternating, 5.0, 10.0).height_m, 0.0);
  EXPECT_EQ(surface_at(saddle, Diagonal::Fixed, 5.0, 10.0).height_m, 8.0);
  // A quarter into the south-east: plane of SW, SE, NE at (3/4, 1/4): 8 * (3/4 - 1/4).
  EXPECT_EQ(surface_at(saddle, Diagonal::Alternating, 7.5, 5.0).height_m, 4.0);
  EXPECT_EQ(surface_at(saddle, Diagonal::Alternating, 7.5, 5.0).triangle, 0u);
  EXPECT_EQ(surface_at(saddle, Diagonal::Alternating, 2.5, 15.0).triangle, 1u);
}

TEST(SurfaceAt, HasNothingOutsideNorOverAVoid) {
  terrain::Heightfield field = cell(1, 2, 3, 4);
  for (const auto& [x, y] :
       {std::pair(-0.1, 5.0), std::pair(10.1, 5.0), std::pair(5.0, -0.1), std::pair(5.0, 20.1)}) {
    EXPECT_FALSE(exists_at(field, Diagonal::Fixed, x, y));
  }
  field.heights_m.floats()(1, 1) = std::numeric_limits<float>::quiet_NaN();
  // Fixed diagonals: the north-eastern half is gone, the south-western one stays, its diagonal
  // included.
  EXPECT_TRUE(exists_at(field, Diagonal::Fixed, 2.0, 4.0));
  EXPECT_TRUE(exists_at(field, Diagonal::Fixed, 5.0, 10.0));
  EXPECT_FALSE(exists_at(field, Diagonal::Fixed, 8.0, 16.0));
  // The rising diagonal needs the missing corner for both halves.
  EXPECT_FALSE(exists_at(field, Diagonal::Alternating, 2.0, 4.0));
}

TEST(SurfaceAt, IsTheSampleAtASample) {
  const terrain::Heightfield field = test_support::rough_terrain(17, 9, 4, 100.0, 0.0, 13.7, 9.1);
  for (const Diagonal diagonal : {Diagonal::Alternating, Diagonal::Fixed, Diagonal::Blocks8}) {
    for (int j = 0; j < 9; ++j) {
      for (int i = 0; i < 17; ++i) {
        // A coordinate is off its sample by an ulp at most, which counts times the slope, below 20.
        EXPECT_NEAR(surface_at(field, diagonal, i * 13.7, j * 9.1).height_m, field.heights_m(i, j),
                    20 * 2e-13);
      }
    }
  }
}

TEST(SurfaceAt, FindsGroundOnTheRimOfAVoidFromEitherSide) {
  terrain::Heightfield field = test_support::rough_terrain(5, 5, 4);
  field.heights_m.floats()(3, 1) = field.heights_m.floats()(3, 2) = field.heights_m.floats()(3, 3) =
      std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(exists_at(field, Diagonal::Alternating, 20.0,
                        25.0));  // the last column that is whole to the west
  EXPECT_FALSE(exists_at(field, Diagonal::Alternating, 21.0, 25.0));
}

// The middle of a rim along a diagonal, computed so that rounding decides on which side of it it
// falls.
TEST(SurfaceAt, FindsGroundOnARimThatRunsAlongADiagonal) {
  terrain::Heightfield field = test_support::rough_terrain(9, 9, 4, 60.0, 0.0, 13.7, 9.1);
  field.heights_m.floats()(4, 5) =
      std::numeric_limits<float>::quiet_NaN();  // leaves the south-eastern half of cell (4, 4)
  for (int k = 0; k <= 1000; ++k) {
    const double share = k / 1000.0;
    const double x = (1.0 - share) * (4 * 13.7) + share * (5 * 13.7);
    const double y = (1.0 - share) * (4 * 9.1) + share * (5 * 9.1);
    const double expected = (1.0 - share) * field.heights_m(4, 4) + share * field.heights_m(5, 5);
    // 1e-9 cells of a slope below 100 m a cell.
    EXPECT_NEAR(surface_at(field, Diagonal::Alternating, x, y).height_m, expected, 1e-6) << share;
  }
}

// Point k of a seed, anywhere in a box of that size from `low`.
glm::dvec3 scattered(std::uint32_t seed, int k, const glm::dvec3& size, const glm::dvec3& low) {
  const glm::dvec3 share{test_support::noise(seed, k, 1), test_support::noise(seed, k, 2),
                         test_support::noise(seed, k, 3)};
  return share * size + low;
}

TEST(NearestOnHeightfield, IsThatOfTryingDenselyEverywhere) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const terrain::Heightfield field =
        test_support::rough_terrain(20, 13, seed, 60.0, 0.05, 10.0, 7.0);
    const HeightPyramid pyramid(field);
    for (int k = 0; k < 60; ++k) {
      const glm::dvec3 point = scattered(seed, k, {240, 130, 120}, {-25, -20, -30});
      const NearestPoint found =
          nearest_on_heightfield(field, Diagonal::Alternating, pyramid, point, 1e6);
      ASSERT_TRUE(found);
      EXPECT_NEAR(
          surface_at(field, Diagonal::Alternating, found.point_m.x, found.point_m.y).height_m,
          found.point_m.z, 1e-9);
      double sampled = std::numeric_limits<double>::infinity();
      constexpr int kPerCell = 16;
      for (int b = 0; b <= 12 * kPerCell; ++b) {
        for (int a = 0; a <= 19 * kPerCell; ++a) {
          const double x = a * 10.0 / kPerCell, y = b * 7.0 / kPerCell;
          const double z = surface_at(field, Diagonal::Alternating, x, y).height_m;
          if (std::isnan(z)) continue;
          const glm::dvec3 d = glm::dvec3(x, y, z) - point;
          sampled = std::min(sampled, std::sqrt(glm::dot(d, d)));
        }
      }
      EXPECT_LE(found.distance_m, sampled + 1e-9);
      // Between points tried, half a step apart in the plane, the surface moves by at most its
      // slope.
      EXPECT_GE(found.distance_m, sampled - 3.0);
    }
  }
}

// A small ball looks at cells, a large one goes down the pyramid.
TEST(NearestOnHeightfield, IsTheSameInABallOfAnySize) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const terrain::Heightfield field =
        test_support::rough_terrain(40, 33, seed, 9.0, 0.05, 10.0, 7.0);
    const HeightPyramid pyramid(field);
    for (int k = 0; k < 200; ++k) {
      const glm::dvec3 point = scattered(seed, k, {400, 240, 15}, {-5, -5, -3});
      const NearestPoint anywhere =
          nearest_on_heightfield(field, Diagonal::Alternating, pyramid, point, 1e6);
      ASSERT_TRUE(anywhere);
      for (const double factor : {1.0, 1.01, 1.5, 3.0, 9.0}) {
        const NearestPoint near = nearest_on_heightfield(field, Diagonal::Alternating, pyramid,
                                                         point, factor * anywhere.distance_m);
        ASSERT_TRUE(near);
        EXPECT_EQ(near.point_m, anywhere.point_m) << "seed " << seed << ", factor " << factor;
      }
      EXPECT_FALSE(nearest_on_heightfield(field, Diagonal::Alternating, pyramid, point,
                                          0.99 * anywhere.distance_m - 2e-9));
    }
  }
}

TEST(NearestOnHeightfield, LooksNoFartherThanAsked) {
  const terrain::Heightfield field = cell(0, 0, 0, 0);
  const HeightPyramid pyramid(field);
  EXPECT_FALSE(nearest_on_heightfield(field, Diagonal::Fixed, pyramid, {5, 10, 30}, 29.0));
  const NearestPoint found =
      nearest_on_heightfield(field, Diagonal::Fixed, pyramid, {5, 10, 30}, 30.0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found.distance_m, 30.0);
  EXPECT_EQ(found.point_m, glm::dvec3(5, 10, 0));
}

TEST(NearestOnHeightfield, OfATerrainWithoutTrianglesIsNone) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(4, 1, 5.0f);
  EXPECT_FALSE(
      nearest_on_heightfield(field, Diagonal::Fixed, HeightPyramid(field), {0, 0, 0}, 1e9));
}

}  // namespace
}  // namespace plumb::reference
