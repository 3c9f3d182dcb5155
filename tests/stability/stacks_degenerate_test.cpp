// Stacks that are hardly any: one of them, one row, one voxel, holes alone, sizes out of
// proportion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/check.h"
#include "support/stack_surfaces.h"
#include "terrain/stacks/stack_pyramid.h"

namespace plumb::mesh::stacks {
namespace {

using terrain::Layer;
using terrain::StackField;
using test_support::check_stack_mesh;
using test_support::filtered;
using test_support::StackMeshCheck;
using test_support::stacks_where;
using test_support::surface_on;

using Layers = std::vector<Layer>;

Layers steps(int i, int j) { return {{0, 4.0F + static_cast<float>((i + 2 * j) % 5), 1}}; }

// A surface ends where the outermost stacks stand: between one row's there is nothing, and what is
// drawn has no area.
TEST(DegenerateStacks, OfOneRowHaveNoArea) {
  for (const auto& [columns, rows] : {std::pair(1, 1), {1, 40}, {40, 1}}) {
    const StackField field = stacks_where(columns, rows, 16, steps);
    for (int level = 0; level < 3; ++level) {
      const TriangleMesh mesh = surface_on(prepare(field), level);
      EXPECT_EQ(check_stack_mesh(mesh, field).degenerate, static_cast<int>(mesh.triangles.size()));
    }
  }
}

// Two rows are the least that has a surface: 39 x 1 m seen from above.
TEST(DegenerateStacks, OfTwoRowsHaveTheirOutline) {
  const StackField field = stacks_where(40, 2, 16, [](int, int) { return Layers{{0, 4.5F, 1}}; });
  const TriangleMesh mesh = surface_on(prepare(field), 0);
  double area_m2 = 0.0;
  for (const Triangle& t : mesh.triangles)
    area_m2 +=
        area_normal(mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]).z / 2;
  EXPECT_EQ(area_m2, 39.0);
}

TEST(DegenerateStacks, OneVoxelHighAreDrawn) {
  const StackField field = stacks_where(20, 20, 1, [](int, int) { return Layers{{0, 1, 1}}; });
  for (int radius = 0; radius < 3; ++radius) {
    for (int level = 0; level < 2; ++level) {
      const StackMeshCheck check =
          check_stack_mesh(surface_on(prepare(field, filtered(radius)), level), field);
      EXPECT_TRUE(check.is_manifold());
      // Half a voxel of level 1: exactly where the ground is, unless it is smoothed.
      if (level == 0 || radius == 0) {
        EXPECT_EQ(check.highest_m, 1.0);
      }
      EXPECT_EQ(check.lowest_m, check.highest_m);
    }
  }
}

TEST(DegenerateStacks, OfHolesAloneAreRefusedInOneLine) {
  StackField field = stacks_where(1, 1, 4, steps);
  field.columns = 3;
  terrain::StackWriter writer(field);
  for (int i = 0; i < 3; ++i) writer.add_hole();
  try {
    prepare(field);
    FAIL() << "drawn";
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("hole"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

// Layers end on eighths of a metre, their middles on sixteenths: a million metres up, the next
// float is that far away. Finer ends would be rounded there, and so would the middles of level 2.
TEST(DegenerateStacks, AMillionMetresUpAreTheSame) {
  const auto ground = [](float low_m) {
    StackField field = stacks_where(1, 1, 16, steps);
    field.columns = field.rows = 20;
    field.low_m = low_m;
    terrain::StackWriter writer(field);
    for (int k = 0; k < 400; ++k)
      writer.add(Layers{{low_m, low_m + 4 + static_cast<float>(k * 7 % 48) / 8, 1}});
    return field;
  };
  for (int level = 0; level < 2; ++level) {
    const TriangleMesh low = surface_on(prepare(ground(0)), level),
                       high = surface_on(prepare(ground(1e6F)), level);
    ASSERT_EQ(low.triangles, high.triangles);
    for (std::size_t v = 0; v < low.vertices_m.size(); ++v)
      EXPECT_EQ(high.vertices_m[v].z, 1e6 + low.vertices_m[v].z);
  }
}

// A plane under 2 m of relief in voxels of a millimetre: 2048 voxels over 4 x 4 stacks, and the
// surface is off by 3/2 - sqrt(2) of one at most, a float's rounding besides.
TEST(DegenerateStacks, OfVoxelsAMillimetreHighAreDrawn) {
  StackField field = stacks_where(4, 4, 2048, [](int, int) { return Layers{}; });
  field.voxel_m = 1e-3;
  terrain::StackWriter writer(field);
  for (int k = 0; k < 16; ++k) writer.add(Layers{{0, 1.2345F, 1}});
  const StackMeshCheck check = check_stack_mesh(surface_on(prepare(field, filtered(0)), 0), field);
  EXPECT_TRUE(check.is_manifold());
  EXPECT_NEAR(check.lowest_m, 1.2345, 1e-3 * (1.5 - std::sqrt(2.0)) + 1e-7);
  EXPECT_EQ(check.lowest_m, check.highest_m);
}

TEST(DegenerateStacks, OfTooManyVoxelsAreRefused) {
  StackField field = stacks_where(2, 2, 1, [](int, int) { return Layers{{0, 1, 1}}; });
  field.voxels = (1 << 24) + 1;
  EXPECT_THROW(prepare(field), std::exception);
}

// Of 2 x 2 stacks nothing is known, and nothing is drawn across them: the surface ends round them,
// 8 cells long on the finest level, 4 on the next, where four holes are one.
TEST(DegenerateStacks, NothingIsDrawnAcrossHoles) {
  StackField field = stacks_where(24, 24, 16, [](int, int) { return Layers{}; });
  terrain::StackWriter writer(field);
  for (int k = 0; k < 24 * 24; ++k) {
    if (k % 24 / 2 == 4 && k / 24 / 2 == 5) {
      writer.add_hole();
    } else {
      writer.add(Layers{{0, 6, 1}});
    }
  }
  EXPECT_TRUE(terrain::halved(field).is_hole(4, 5));
  for (int level = 0; level < 2; ++level) {
    const TriangleMesh mesh = surface_on(prepare(field), level);
    const StackMeshCheck check = check_stack_mesh(mesh, field);
    EXPECT_EQ(check.open, level == 0 ? 8 : 4);
    EXPECT_EQ(check.crowded, 0);
    EXPECT_EQ(check.lowest_m, 6.0);
    EXPECT_EQ(check.highest_m, 6.0);
    for (const Triangle& t : mesh.triangles) {
      const glm::dvec3 middle =
          (mesh.vertices_m[t[0]] + mesh.vertices_m[t[1]] + mesh.vertices_m[t[2]]) / 3.0;
      EXPECT_FALSE(middle.x > 7.5 && middle.x < 9.5 && middle.y > 9.5 && middle.y < 11.5);
    }
  }
}

// The vertex between them has a fan of faces on either side: four edges of one face each.
TEST(DegenerateStacks, HolesThatTouchByACornerTearAVertex) {
  StackField field = stacks_where(12, 12, 16, [](int, int) { return Layers{}; });
  terrain::StackWriter writer(field);
  for (int k = 0; k < 12 * 12; ++k) {
    if (k == 5 * 12 + 5 || k == 6 * 12 + 6) {
      writer.add_hole();
    } else {
      writer.add(Layers{{0, 6, 1}});
    }
  }
  const TriangleMesh mesh = surface_on(prepare(field), 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++faces[std::minmax(t[k], t[(k + 1) % 3])];
  }
  std::map<std::uint32_t, int> open_edges;
  for (const auto& [edge, count] : faces) {
    if (count > 1) continue;
    ++open_edges[edge.first];
    ++open_edges[edge.second];
  }
  const auto torn = std::count_if(open_edges.begin(), open_edges.end(),
                                  [](const auto& vertex) { return vertex.second == 4; });
  EXPECT_EQ(torn, 1);
}

}  // namespace
}  // namespace plumb::mesh::stacks
