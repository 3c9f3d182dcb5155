// Heights drawn as stacks: measured against their own triangles, and ended where these end.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "mesh/stacks/height_cut.h"
#include "mesh/stacks/height_surface.h"
#include "mesh/stacks/stacks.h"
#include "support/test_terrain.h"
#include "terrain/camera_presets.h"

namespace plumb::mesh::stacks {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

Heightfield written(int columns, const std::vector<float>& heights) {
  Heightfield field;
  Grid<float> grid(columns, static_cast<int>(heights.size()) / columns);
  std::copy(heights.begin(), heights.end(), grid.values().begin());
  field.heights_m = terrain::HeightGrid(std::move(grid));
  return field;
}

HeightSurface surface_of(const Heightfield& field) {
  return HeightSurface(field, Diagonal::Alternating);
}

// Of one cell, its north-eastern sample 4 m up, which the diagonal climbs.
TEST(HeightSurface, IsOffMostWhereEdgesCross) {
  const HeightSurface heights = surface_of(written(2, {0, 0, 0, 4}));
  EXPECT_EQ(heights.off_m({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}), 4.0);
  // South-west of the other diagonal: none of its corners is off, its middle is below 2 m.
  EXPECT_EQ(heights.off_m({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), 2.0);
  EXPECT_EQ(heights.off_m({{{0, 0, 3}, {1, 0, 3}, {0, 1, 3}}}), 3.0);
}

TEST(HeightSurface, IsOffWhereASampleStandsWithinATriangle) {
  const HeightSurface heights = surface_of(written(3, {0, 0, 0, 0, 7, 0, 0, 0, 0}));
  EXPECT_EQ(heights.off_m({{{0, 0, 0}, {2, 0, 0}, {1, 2, 0}}}), 7.0);
}

TEST(HeightSurface, IsNothingOverVoids) {
  const HeightSurface heights = surface_of(written(2, {0, 0, kVoid, 4}));
  EXPECT_TRUE(heights.exists({0, 0, 0}));
  EXPECT_FALSE(heights.exists({0, 0, 1}));
  EXPECT_LT(heights.off_m({{{0.1, 0.2, 0}, {0.7, 0.9, 0}, {0.1, 0.9, 0}}}), 0.0);
  EXPECT_EQ(heights.off_m({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), 2.0);
}

double plan_area(const TriangleMesh& mesh) {
  double twice = 0.0;
  for (const Triangle& t : mesh.triangles)
    twice += area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]).z;
  return 0.5 * twice;
}

DrawnSurface square_of_two(double side) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices_m = {{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  DrawnSurface surface;
  surface.patches = {{0, 1, 0, "one"}, {1, 1, 1, "other"}};
  surface.triangle_lod = {0, 1};
  surface.mesh = std::move(mesh);
  return surface;
}

// A void takes with it the triangles that it is a corner of: of four cells in eight triangles.
TEST(CutToHeights, LeavesWhatExists) {
  const auto left = [](std::size_t hole) {
    std::vector<float> heights(9, 0.0F);
    heights[hole] = kVoid;
    DrawnSurface surface = square_of_two(2.0);
    cut_to_heights(surface_of(written(3, heights)), surface);
    return plan_area(*surface.mesh);
  };
  EXPECT_DOUBLE_EQ(left(8), 3.0);  // a diagonal's end: both triangles of its cell
  EXPECT_DOUBLE_EQ(left(1), 3.0);  // between two cells: one of each
  EXPECT_DOUBLE_EQ(left(4), 0.0);  // all eight meet in the middle
}

TEST(CutToHeights, LeavesAWholeTerrainAsItIs) {
  DrawnSurface surface = square_of_two(2.0);
  const auto before = surface.mesh;
  cut_to_heights(surface_of(written(3, std::vector<float>(9, 0.0F))), surface);
  EXPECT_EQ(surface.mesh, before);
}

TEST(CutToHeights, KeepsPatchesAndLevels) {
  std::vector<float> heights(25, 0.0F);
  heights[3] = heights[4] = heights[9] = kVoid;  // the south-eastern corner
  DrawnSurface surface = square_of_two(4.0);
  cut_to_heights(surface_of(written(5, heights)), surface);
  ASSERT_EQ(surface.patches.size(), 2u);
  EXPECT_EQ(surface.patches[1].triangle_count, 16u);  // half of 16 cells, all of which exist
  EXPECT_EQ(surface.patches[1].first_triangle, surface.patches[0].triangle_count);
  EXPECT_EQ(surface.triangle_lod.size(), surface.mesh->triangles.size());
  EXPECT_EQ(surface.triangle_lod.back(), 1);
}

using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

Edges open_edges(const TriangleMesh& mesh) {
  Edges edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{t[k], t[(k + 1) % 3]}];
      --edges[{t[(k + 1) % 3], t[k]}];
    }
  }
  std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
  return edges;
}

double area_that_exists(const Heightfield& field) {
  const HeightSurface heights = surface_of(field);
  double area = 0.0;
  for (int j = 0; j < field.cell_rows(); ++j)
    for (int i = 0; i < field.cell_columns(); ++i)
      for (int half = 0; half < 2; ++half)
        area += heights.exists({i, j, half}) ? 0.5 * field.dx_m * field.dy_m : 0.0;
  return area;
}

Prepared prepared_of(const Heightfield& field) {
  return prepare(terrain::stacks_of(field), {},
                 std::make_shared<const HeightSurface>(field, Diagonal::Alternating));
}

// On every level, with voids and without: the plan is covered once, and the surface ends at the
// voids alone. Areas of 1e5 m^2 are sums of 1e5 terms, each rounded by parts of 1e-16.
TEST(StacksOfHeights, EndWhereTheHeightsDo) {
  for (const std::uint32_t seed : {1, 2, 3}) {
    const Heightfield field =
        test_support::rough_terrain(40, 37, seed, 120.0, 0.05 * (seed - 1), 10.0, 7.0);
    const Prepared prepared = prepared_of(field);
    const Camera camera = make_camera(terrain::preset_camera(field, "oblique", 320, 180, 50.0));
    const HeightSurface heights = surface_of(field);
    for (const double tolerance_px : {1.0, 20.0, 200.0}) {
      const DrawnSurface surface = draw(prepared, camera, {tolerance_px, Unit::Pixel});
      const TriangleMesh& mesh = *surface.mesh;
      EXPECT_NEAR(plan_area(mesh), area_that_exists(field), 1e-6) << seed << " " << tolerance_px;
      for (const auto& [edge, count] : open_edges(mesh)) {
        const glm::dvec3 middle =
            0.5 * (mesh.vertices_m[edge.first] + mesh.vertices_m[edge.second]);
        const glm::dvec3 near{1e-3, 1e-3, 0.0};
        const bool is_at_rim = middle.x < 1e-3 || middle.y < 1e-3 ||
                               middle.x > 39 * field.dx_m - 1e-3 ||
                               middle.y > 36 * field.dy_m - 1e-3;
        EXPECT_TRUE(is_at_rim || !heights.is_whole(middle - near, middle + near))
            << middle.x << " " << middle.y;
      }
    }
  }
}

// What the finest level misses is said; and where it misses nothing the tolerance is the claim.
TEST(StacksOfHeights, ClaimTheToleranceOrWhatIsReached) {
  const Heightfield field = test_support::rough_terrain(40, 37, 1);
  const Prepared prepared = prepared_of(field);
  const Camera camera = make_camera(terrain::preset_camera(field, "oblique", 320, 180, 50.0));
  const DrawnSurface near = draw(prepared, camera, {0.01, Unit::Pixel}),
                     far = draw(prepared, camera, {200.0, Unit::Pixel});
  ASSERT_EQ(near.claims.size(), 2u);
  EXPECT_TRUE(near.claims[0].unreachable);
  EXPECT_GT(near.claims[0].bound, 0.01);
  EXPECT_GT(near.out_of_reach_m, 0.0);
  EXPECT_EQ(far.claims[0], (Claim{Measure::SurfaceError, 200.0, Unit::Pixel}));
  EXPECT_EQ(far.out_of_reach_m, 0.0);
  double off_m = 0.0;
  for (const Triangle& t : near.mesh->triangles)
    off_m = std::max(
        off_m, surface_of(field).off_m({near.mesh->vertices_m[t[0]], near.mesh->vertices_m[t[1]],
                                        near.mesh->vertices_m[t[2]]}));
  EXPECT_DOUBLE_EQ(near.out_of_reach_m, off_m);
}

// A mesh that is not empty is of a node that may have faces; of most others it is known.
TEST(MayHaveFaces, IsFalseOfEmptyNodesAlone) {
  const StackDensities densities(
      terrain::stacks_of(test_support::rough_terrain(150, 130, 4, 900.0)), {});
  Octree octree(densities.size());
  octree.divide([](const Node& node) { return node.level > 1 || node.at.x < 1; });
  octree.balance();
  int empty = 0, told = 0;
  for (const Node& node : octree.drawn()) {
    const Surroundings around = octree.surroundings(node);
    const NodeMesh mesh = node_mesh(
        node, around,
        [&](int level, const dual_contouring::LatticeBox& box) { return densities(level, box); },
        {Variant::Conservative, dual_contouring::Placement::Mean, glm::ivec2(densities.size())});
    const bool may =
        may_have_faces(node, around, [&](int level, const dual_contouring::LatticeBox& box) {
          return densities.uniform(level, box);
        });
    EXPECT_TRUE(may || mesh.faces.empty());
    empty += mesh.faces.empty() ? 1 : 0;
    told += may ? 0 : 1;
  }
  EXPECT_GT(told, empty / 2);
}

}  // namespace
}  // namespace plumb::mesh::stacks
