// Closed meshes as stacks: forms whose columns are known.
#include "terrain/stacks/stack_import_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/check.h"
#include "support/random_scene.h"
#include "support/test_meshes.h"
#include "terrain/mesh_file.h"
#include "terrain/stacks/column_crossings.h"

namespace plumb::terrain {
namespace {

using test_support::Random;

void add_box(TriangleMesh& mesh, const glm::dvec3& low, const glm::dvec3& high) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (int k = 0; k < 8; ++k)
    mesh.vertices_m.push_back({(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                               (k & 4) != 0 ? high.z : low.z});
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}}) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
  }
}

TriangleMesh box_mesh(const glm::dvec3& low, const glm::dvec3& high) {
  TriangleMesh mesh;
  add_box(mesh, low, high);
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// A ring of radius 4 about z, its tube of radius 1.
TriangleMesh torus_mesh(std::uint32_t around, std::uint32_t tube) {
  TriangleMesh mesh;
  for (std::uint32_t a = 0; a < around; ++a) {
    for (std::uint32_t b = 0; b < tube; ++b) {
      const double u = 2.0 * std::numbers::pi * a / around, v = 2.0 * std::numbers::pi * b / tube;
      const double r = 4.0 + std::cos(v);
      mesh.vertices_m.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
      const std::uint32_t a1 = (a + 1) % around, b1 = (b + 1) % tube;
      mesh.triangles.push_back({a * tube + b, a1 * tube + b, a1 * tube + b1});
      mesh.triangles.push_back({a * tube + b, a1 * tube + b1, a * tube + b1});
    }
  }
  return mesh;
}

std::string refusal(const TriangleMesh& mesh, const MeshStackOptions& options = {}) {
  try {
    stacks_of_mesh(mesh, "m.ply", options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was taken";
}

// The stack at a place relative to the mesh's origin.
std::vector<Layer> layers_at(const TriangleMesh& mesh, const StackField& field, double x,
                             double y) {
  const double i = (mesh.origin_m.x + x - field.origin_m.x) / field.dx_m,
               j = (mesh.origin_m.y + y - field.origin_m.y) / field.dy_m;
  return layers_of(field, static_cast<int>(std::lround(i)), static_cast<int>(std::lround(j)));
}

// Its corners, edges and diagonals stand on stacks. Of a line that is moved a little to the north
// and east the box holds those on its western and southern sides, not those on the others: 3 x 2.
TEST(StackImportMesh, HoldsABoxWhoseCornersAreOnStacks) {
  const TriangleMesh box = box_mesh({0, 0, 1}, {3, 2, 5});
  for (const TriangleMesh& mesh : {box, turned(box)}) {
    const MeshStacks result = stacks_of_mesh(mesh, "box", {.beside_m = 1.0});
    const StackField& field = result.field;
    require_valid(field);
    EXPECT_EQ(field.columns, 7);  // -2 to 4
    EXPECT_EQ(field.rows, 6);     // -2 to 3
    EXPECT_EQ(field.low_m, 0.0F);
    EXPECT_EQ(result.repaired, 0);
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 7; ++i) {
        const bool in = i >= 2 && i < 5 && j >= 2 && j < 4;
        EXPECT_EQ(field.stack(i, j).size(), in ? 2u : 0u) << i << ", " << j;
        if (in) {
          EXPECT_EQ(field.stack(i, j).start_m(1), 1.0F);
          EXPECT_EQ(field.stack(i, j).end_m[1], 5.0F);
        }
      }
    }
    EXPECT_EQ(volumes_m3(field)[1], 24.0);
    EXPECT_EQ(std::abs(signed_volume_m3(mesh)), 24.0);
  }
}

// x, y, z >= 0 with x + y + z <= 4: over (x, y) as high as 4 - x - y, at the corner all four.
TEST(StackImportMesh, HoldsATetrahedron) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  mesh.origin_m = {500000.0, 4000000.0, 100.0};
  const StackField field = stacks_of_mesh(mesh, "t", {.spacing_m = 0.5, .voxel_m = 1.0}).field;
  EXPECT_EQ(field.origin_m, glm::dvec2(499999.5, 3999999.5));
  for (int j = -1; j <= 8; ++j) {
    for (int i = -1; i <= 8; ++i) {
      const StackView stack = field.stack(i + 1, j + 1);
      const bool in = i >= 0 && j >= 0 && i + j < 8;
      ASSERT_EQ(stack.size(), in ? 2u : 0u) << i << ", " << j;
      if (in) {
        EXPECT_EQ(stack.start_m(1), 100.0F);
        EXPECT_EQ(stack.end_m[1], 104.0F - 0.5F * static_cast<float>(i + j));
      }
    }
  }
}

// The mesh lies between the sphere and a smaller one that touches its facets; and so do chords,
// but for half a unit of single precision (2^-22 at 2 to 4 m) at either end.
TEST(StackImportMesh, HoldsASphereWithinItsFacets) {
  const TriangleMesh mesh = test_support::sphere_mesh(3.0, 5);
  const double least_m = 3.0 - test_support::sagitta_m(mesh, 3.0), rounding_m = 0x1p-22;
  const StackField field = stacks_of_mesh(mesh, "sphere", {.spacing_m = 0.25}).field;
  int chords = 0;
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const double x = field.origin_m.x + 0.25 * i, y = field.origin_m.y + 0.25 * j;
      const double d2 = x * x + y * y;
      const StackView stack = field.stack(i, j);
      if (d2 > 9.0) {
        EXPECT_EQ(stack.size(), 0u);
      } else if (d2 < least_m * least_m) {
        ASSERT_EQ(stack.size(), 2u) << x << ", " << y;
        const double chord_m = double{stack.end_m[1]} - double{stack.end_m[0]};
        EXPECT_LE(chord_m, 2.0 * std::sqrt(9.0 - d2) + rounding_m);
        EXPECT_GE(chord_m, 2.0 * std::sqrt(least_m * least_m - d2) - rounding_m);
        ++chords;
      }
    }
  }
  EXPECT_GT(chords, 400);  // 9 pi / 0.0625 = 452
}

// Stood on its rim, the ring's middle column passes the tube twice: z from 3 to 5 and below.
TEST(StackImportMesh, HoldsARingAsTwoIntervals) {
  TriangleMesh mesh = torus_mesh(64, 32);
  for (glm::dvec3& v : mesh.vertices_m) v = {v.x, -v.z, v.y};
  const StackField field = stacks_of_mesh(mesh, "ring", {.spacing_m = 0.5}).field;
  const std::vector<Layer> layers = layers_at(mesh, field, 0.0, 0.0);
  ASSERT_EQ(layers.size(), 5u);
  for (const auto& [k, low_m, high_m] : {std::tuple{1u, -5.0, -3.0}, {3u, 3.0, 5.0}}) {
    EXPECT_EQ(layers[k].material, 1);
    EXPECT_NEAR(layers[k].start_m, low_m, 1e-6);  // a vertex stands there, to a float's rounding
    EXPECT_NEAR(layers[k].end_m, high_m, 1e-6);
  }
  // Lain down, its middle is air and its tube 2 m high over x = 4.
  const TriangleMesh flat = torus_mesh(64, 32);
  const StackField lying = stacks_of_mesh(flat, "ring", {.spacing_m = 0.5}).field;
  EXPECT_EQ(layers_at(flat, lying, 0.0, 0.0).size(), 1u);
  EXPECT_NEAR(layers_at(flat, lying, 4.0, 0.0)[1].end_m, 1.0, 1e-6);
}

// [0, 4] and [2, 6] up: one layer where they overlap, and one void in rock of 1 m around.
TEST(StackImportMesh, JoinsBoxesThatOverlap) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
  add_box(mesh, {1, 1, 2}, {3, 3, 6});
  const StackField field = stacks_of_mesh(mesh, "boxes").field;
  EXPECT_EQ(layers_at(mesh, field, 2, 2),
            (std::vector<Layer>{{-1.0F, 0.0F, 0}, {0.0F, 6.0F, 1}, {6.0F, 7.0F, 0}}));
  EXPECT_EQ(volumes_m3(field)[1], 4 * 4 * 4 + 2 * 2 * 2);
  for (const TriangleMesh& wound : {mesh, turned(mesh)}) {
    const StackField rock =
        stacks_of_mesh(wound, "boxes",
                       {.subtract = true, .below_m = 2.0, .above_m = 3.0, .beside_m = 1.0})
            .field;
    EXPECT_EQ(
        layers_at(wound, rock, 2, 2),
        (std::vector<Layer>{{-3.0F, 0.0F, 1}, {0.0F, 6.0F, 0}, {6.0F, 9.0F, 1}, {9.0F, 10.0F, 0}}));
    EXPECT_EQ(layers_at(wound, rock, 5, 5),
              (std::vector<Layer>{{-3.0F, 9.0F, 1}, {9.0F, 10.0F, 0}}));
    EXPECT_EQ(volumes_m3(rock)[0], 4 * 4 * 4 + 2 * 2 * 2);
  }
}

// A box within a box, wound the other way, is a void of winding zero.
TEST(StackImportMesh, LeavesAVoidThatIsWoundInwards) {
  TriangleMesh inner = turned(box_mesh({1, 1, 1}, {3, 3, 3}));
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
  for (Triangle t : inner.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices_m.insert(mesh.vertices_m.end(), inner.vertices_m.begin(), inner.vertices_m.end());
  EXPECT_EQ(
      layers_at(mesh, stacks_of_mesh(mesh, "m").field, 2, 2),
      (std::vector<Layer>{
          {-1.0F, 0.0F, 0}, {0.0F, 1.0F, 1}, {1.0F, 3.0F, 0}, {3.0F, 4.0F, 1}, {4.0F, 5.0F, 0}}));
}

// Vertices on whole metres, triangles of any shape between them, many of them vertical or without
// an area, and every line through vertices and along edges: a closed mesh is closed on all.
TEST(ColumnCrossings, AddUpToZeroOnEveryLineThroughAClosedMesh) {
  Random random(21);
  LineGrid lines;
  for (int k = -1; k <= 6; ++k) {
    lines.x_m.push_back(k);
    lines.y_m.push_back(k);
  }
  std::int64_t crossed = 0;
  for (int round = 0; round < 300; ++round) {
    TriangleMesh mesh = test_support::sphere_mesh(1.0, 1);  // 18 vertices, 32 triangles
    for (glm::dvec3& v : mesh.vertices_m)
      v = {random.integer(0, 5), random.integer(0, 5), random.integer(0, 5)};
    ASSERT_EQ(count_edges(mesh).boundary, 0);
    const Crossings crossings = cross(mesh, lines);
    for (std::size_t line = 0; line < lines.size(); ++line) {
      int sum = 0;
      for (auto k = crossings.first[line]; k < crossings.first[line + 1]; ++k) {
        sum += crossings.of[k].sign;
        ++crossed;
      }
      ASSERT_EQ(sum, 0) << round << ", line " << line;
    }
  }
  EXPECT_GT(crossed, 10000);
}

TEST(StackImportMesh, RefusesAnOpenMeshAndNamesThePlace) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {2, 2, 2});
  mesh.origin_m = {100.0, 200.0, 300.0};
  mesh.triangles.erase(mesh.triangles.begin());  // of the bottom: 0, 2, 3
  EXPECT_EQ(
      refusal(mesh),
      "m.ply: expected a closed mesh, 3 edges have one triangle only, the first at (101, 201, "
      "300) m");
  EXPECT_NE(refusal({}).find("there are none"), std::string::npos);
  mesh = box_mesh({0, 0, 0}, {2, 2, 2});
  EXPECT_THROW(stacks_of_mesh(mesh, "m", {.spacing_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(stacks_of_mesh(mesh, "m", {.below_m = -1.0}), std::invalid_argument);
  EXPECT_NE(refusal(mesh, {.spacing_m = 1e-9}).find("m.ply"), std::string::npos);
  mesh.vertices_m[3].z = NAN;
  EXPECT_THROW(stacks_of_mesh(mesh, "m"), std::invalid_argument);
}

// A flat pocket in a box both of whose sides face up: lines through it do not close. One of 2 m a
// side stands on one stack of 51 x 51, which gets a neighbour's layers; one of 25 m on more than a
// hundredth of them, which is refused.
TEST(StackImportMesh, RepairsStacksWhoseLinesDoNotClose) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {50, 50, 10});
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.insert(mesh.vertices_m.end(),
                         {{20.5, 20.5, 5}, {22.5, 20.5, 5}, {20.5, 22.5, 5}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 1, first + 2});
  const MeshStacks result = stacks_of_mesh(mesh, "m");
  EXPECT_EQ(result.unbalanced_edges, 3);
  EXPECT_EQ(result.repaired, 1);  // over (21, 21); (22, 21) and (21, 22) lie on its far side
  EXPECT_EQ(result.first_repaired_column, 22);
  EXPECT_EQ(result.first_repaired_row, 22);
  EXPECT_EQ(volumes_m3(result.field)[1], 50.0 * 50.0 * 10.0);
  EXPECT_NE(result.field.provenance.assumptions.back().find("1 stacks"), std::string::npos);
  mesh.vertices_m[first + 1].x = mesh.vertices_m[first + 2].y = 45.5;
  EXPECT_NE(refusal(mesh).find("the mesh's inside has no end"), std::string::npos);
}

// A lidar scan, wound so that normals point into the void; three edges of more than two triangles.
TEST(StackImportMesh, FindsTheVoidOfAScannedCave) {
  const std::string path = PLUMB_SOURCE_DIR "/../shared/data/banba_cave.ply";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const TriangleMesh mesh = read_mesh(path, {.origin_m = {}, .up_axis = UpAxis::Y}).mesh;
  const double volume_m3 = std::abs(signed_volume_m3(mesh));
  EXPECT_NEAR(volume_m3, 1095.0, 1.0);
  double area_m2 = 0.0;
  for (const Triangle& t : mesh.triangles)
    area_m2 += 0.5 * glm::length(area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]],
                                             mesh.vertices_m[t[2]]));
  const Box box = bounds(mesh);
  for (const double spacing_m : {0.5, 0.2, 0.1}) {
    const MeshStacks result = stacks_of_mesh(
        mesh, "cave", {.spacing_m = spacing_m, .subtract = true, .below_m = 1.0, .above_m = 1.0});
    require_valid(result.field);
    EXPECT_EQ(result.non_manifold_edges, 3);
    EXPECT_EQ(result.repaired, 0);
    const double off_m3 = volumes_m3(result.field)[0] - volume_m3;
    // A wall over a cell is moved by under half a cell each way: the cell's size times half of the
    // area, if all walls were to err to one side.
    EXPECT_LT(std::abs(off_m3), 0.5 * spacing_m * area_m2) << spacing_m;
    // They do not: of a wall of height h and length l = area / h, the l / s cells err evenly in
    // half a cell each way, by s^2 h / sqrt(12) each: sqrt(s^3 h area / 12) together. Four of
    // these.
    const double height_m = box.high.z - box.low.z;
    EXPECT_LT(std::abs(off_m3), 4.0 * std::sqrt(std::pow(spacing_m, 3) * height_m * area_m2 / 12.0))
        << spacing_m;
    RecordProperty("off_m3_at_" + std::to_string(spacing_m), std::to_string(off_m3));
  }
}

}  // namespace
}  // namespace plumb::terrain
