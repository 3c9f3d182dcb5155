// Where stacks and their contours fail, by name: what is lost on the way from layers to a surface,
// and what one vertex a cell makes of two sheets.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

#include "support/stack_surfaces.h"
#include "terrain/stacks/stack_pyramid.h"
#include "terrain/stacks/stack_source.h"

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
constexpr terrain::Material kRock = 1, kSand = 2;
constexpr Variant kBoth[] = {Variant::Published, Variant::Conservative};

StackMeshCheck finest_of(const StackField& field, const Parameters& parameters) {
  return check_stack_mesh(surface_on(prepare(field, parameters), 0), field);
}

double highest_m(const StackField& field, int radius) {
  return finest_of(field, filtered(radius)).highest_m;
}

// A plate over ground at 2 m that begins a part of the way up a voxel.
StackField plate(float part, float thickness_m) {
  return stacks_where(20, 20, 16, [&](int, int) {
    return Layers{{0, 2, kRock}, {8 + part, 8 + part + thickness_m, kRock}};
  });
}

// Unfiltered a plate must fill more than half of some voxel. Of one that begins p of a voxel up,
// the Gauss filter leaves in its first two voxels (1 - p) / 2 + (t - 1 + p) / 4 and
// (1 - p) / 4 + (t - 1 + p) / 2, which is more than 1/2 for t > min(1 + p, (3 - p) / 2): at most
// 4/3. In voxels of the level: on level L it is 2^L times that.
TEST(StacksFail, LayersThinnerThanAVoxelAreLost) {
  for (int k = 0; k < 8; ++k) {
    const float part = static_cast<float>(k) / 8;
    SCOPED_TRACE(part);
    EXPECT_LT(highest_m(plate(part, 0.5F), 0), 3.0);
    EXPECT_GT(highest_m(plate(part, 1.0625F), 0), 8.0);
    const float least_m = std::min(1 + part, (3 - part) / 2);
    EXPECT_LT(highest_m(plate(part, least_m - 0.0625F), 1), 3.0);
    EXPECT_GT(highest_m(plate(part, least_m + 0.0625F), 1), 8.0);
  }
  const StackField thick = plate(0, 2);
  EXPECT_GT(highest_m(thick, 1), 8.0);
  EXPECT_LT(check_stack_mesh(surface_on(prepare(thick), 1), thick).highest_m, 4.0);
}

StackField wall(int first, int columns) {
  return stacks_where(32, 32, 16, [&](int i, int) {
    return Layers{{0, i >= first && i < first + columns ? 12.0F : 4.0F, kRock}};
  });
}

// 1/4, 1/2, 1/4 leave exactly half of it, which is outside: but for what the ground lends its first
// voxel, which ends at the next one's middle, 8 m are lost. (A mean rounds the edges that stay.)
TEST(StacksFail, AWallOneColumnWideIsLost) {
  EXPECT_EQ(highest_m(wall(16, 1), 0), 11.75);
  EXPECT_LE(highest_m(wall(16, 1), 1), 5.5);
  EXPECT_GT(highest_m(wall(16, 2), 1), 11.5);
}

// Two columns of one pair are one column of level 1: lost there. Of two pairs they are half of
// each, so that between ground and air the tie is parted: a wall twice as wide and half as high.
TEST(StacksFail, AWallOfTwoColumnsIsLostOrHalvedOneLevelUp) {
  const StackField one_pair = wall(16, 2), two_pairs = wall(15, 2);
  EXPECT_LT(check_stack_mesh(surface_on(prepare(one_pair), 1), one_pair).highest_m, 7.0);
  const terrain::StackField level = terrain::halved(two_pairs);
  EXPECT_EQ(level.stack(7, 3).end_m.back(), 8.0F);
  EXPECT_EQ(level.stack(8, 3).end_m.back(), 8.0F);
  const double highest_m = check_stack_mesh(surface_on(prepare(two_pairs), 1), two_pairs).highest_m;
  EXPECT_GT(highest_m, 7.0);
  EXPECT_LE(highest_m, 8.0);
}

// Of one voxel the filter leaves a half: where rock was 12 m high one looks 8 m down.
TEST(StacksFail, ACavesRoofThinnerThanTheFilterOpens) {
  const auto cave = [](float roof_m) {
    return stacks_where(16, 16, 16, [&](int i, int j) {
      const bool is_cave = i > 3 && i < 12 && j > 3 && j < 12;
      return is_cave ? Layers{{0, 4, kRock}, {12 - roof_m, 12, kRock}} : Layers{{0, 12, kRock}};
    });
  };
  const auto over_the_middle_m = [](const StackField& field, int radius) {
    double highest = 0.0;
    for (const glm::dvec3& at : surface_on(prepare(field, filtered(radius)), 0).vertices_m)
      if (std::abs(at.x - 7.5) < 2 && std::abs(at.y - 7.5) < 2) highest = std::max(highest, at.z);
    return highest;
  };
  EXPECT_EQ(over_the_middle_m(cave(1), 0), 12.0);
  EXPECT_EQ(over_the_middle_m(cave(1), 1), 4.0);
  EXPECT_EQ(over_the_middle_m(cave(2), 1), 12.0);
}

// A stalagmite and a stalactite whose tips are opposite corners of one cell: one vertex for both
// sheets, whose faces are two fans.
TEST(StacksFail, TwoSurfacesInOneCellShareAVertexAsPublished) {
  const StackField field = stacks_where(8, 8, 16, [](int i, int j) {
    if (i == 3 && j == 3) return Layers{{0, 8, kRock}, {12, 14, kRock}};
    if (i == 4 && j == 4) return Layers{{0, 4, kRock}, {8, 14, kRock}};
    return Layers{{0, 4, kRock}, {12, 14, kRock}};
  });
  const StackMeshCheck published = finest_of(field, filtered(0, Variant::Published));
  EXPECT_EQ(published.torn, 1);
  EXPECT_EQ(published.open + published.crowded, 0);
  EXPECT_TRUE(finest_of(field, filtered(0)).is_manifold());
}

// One voxel between 8 and 9 m, rock in every second column: over each of the 7 x 7 cells of a
// layer two of the 36 masks lie back to back.
TEST(StacksFail, MasksOfTwoCurvesBackToBackAreCrowdedAsPublished) {
  const StackField field = stacks_where(8, 8, 16, [](int i, int j) {
    const bool is_cavity = (i + j) % 2 == 1 && i > 0 && j > 0 && i < 7 && j < 7;
    return is_cavity ? Layers{{0, 8, kRock}, {9, 14, kRock}} : Layers{{0, 14, kRock}};
  });
  const StackMeshCheck published = finest_of(field, filtered(0, Variant::Published));
  EXPECT_GT(published.crowded, 0);
  EXPECT_GT(published.torn, 0);
  EXPECT_EQ(published.open, 0);
  EXPECT_TRUE(finest_of(field, filtered(0)).is_manifold());
  std::printf("back to back: published has %d crowded edges, %d torn vertices\n", published.crowded,
              published.torn);
}

// What it amounts to where nobody built it so: nothing where caves are many voxels wide, and one
// vertex in 300 where voxels are 8 m.
TEST(StacksFail, CoarseCavesAreNoManifoldAsPublished) {
  int torn = 0, crowded = 0, vertices = 0;
  const StackField field = terrain::generate_stacks("generate:caves?size=129&spacing=8");
  for (int level = 0; level < 3; ++level) {
    const TriangleMesh mesh = surface_on(prepare(field, filtered(1, Variant::Published)), level);
    const StackMeshCheck published = check_stack_mesh(mesh, field);
    EXPECT_EQ(published.open, 0);
    torn += published.torn;
    crowded += published.crowded;
    vertices += static_cast<int>(mesh.vertices_m.size());
    EXPECT_TRUE(check_stack_mesh(surface_on(prepare(field), level), field).is_manifold());
  }
  EXPECT_GT(torn, vertices / 1000);
  EXPECT_LT(torn, vertices / 100);
  std::printf("caves of 8 m: published has %d torn vertices of %d, %d crowded edges\n", torn,
              vertices, crowded);
  const StackField fine = terrain::generate_stacks("generate:caves?size=129");
  const Prepared smooth = prepare(fine, filtered(1, Variant::Published));
  EXPECT_TRUE(check_stack_mesh(surface_on(smooth, 0), fine).is_manifold());
}

// Two columns of each in every four: nothing dominates below ground, no votes, equal thickness. The
// lowest index takes all of it, and the mixed colour is gone from the first level on.
TEST(StacksFail, ACheckerboardTieBetweenMaterialsGoesToTheFirst) {
  const StackField field = stacks_where(16, 16, 16, [](int i, int j) {
    return Layers{{0, 8, (i + j) % 2 == 0 ? kRock : kSand}};
  });
  const StackField level = terrain::halved(field);
  for (int j = 0; j < level.rows; ++j) {
    for (int i = 0; i < level.columns; ++i) {
      const terrain::StackView stack = level.stack(i, j);
      ASSERT_EQ(stack.size(), 1u);
      EXPECT_EQ(stack.material[0], kRock);
      EXPECT_EQ(stack.end_m[0], 8.0F);
    }
  }
}

// Every second row of columns is 15 m of rock, the others are air: all ground is tied. The only
// vote is the air's above, and level 1 has no ground at all; filled to the top there is no vote,
// both are as thick, and level 1 is rock without a gap.
TEST(StacksFail, TiedSegmentsOnlyAreAllAirOrAllRock) {
  const auto rows_up_to = [](float high_m) {
    return terrain::halved(stacks_where(16, 16, 16, [&](int, int j) {
      return j % 2 == 0 ? Layers{{0, high_m, kRock}} : Layers{};
    }));
  };
  EXPECT_EQ(rows_up_to(15).end_m.size(), 0u);
  const StackField full = rows_up_to(16);
  EXPECT_EQ(full.end_m, std::vector<float>(64, 16.0F));
}

// Half a voxel is outside, and the crossing then lies at that voxel's middle: where the ground is.
TEST(StacksFail, NotOnADensityOfExactlyOneHalf) {
  const StackField ground = stacks_where(8, 8, 16, [](int, int) {
    return Layers{{0, 8.5F, kRock}};
  });
  const StackField half = stacks_where(8, 8, 16, [](int, int) {
    return Layers{{0, 2, kRock}, {8.25F, 8.75F, kRock}};
  });
  for (const Variant variant : kBoth) {
    const StackMeshCheck check = finest_of(ground, filtered(0, variant));
    EXPECT_TRUE(check.is_manifold());
    EXPECT_EQ(check.lowest_m, 8.5);
    EXPECT_EQ(check.highest_m, 8.5);
    EXPECT_EQ(finest_of(half, filtered(0, variant)).highest_m, 2.0);
  }
}

int without_area(const TriangleMesh& mesh) {
  int count = 0;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.vertices_m[t[0]];
    const glm::dvec3 normal = glm::cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    count += normal == glm::dvec3(0.0) ? 1 : 0;
  }
  return count;
}

// A cross of seven voxels of air in rock: 8 + 6 * 4 of 64 are exactly half in its middle, which is
// outside, and every voxel beside that is inside. All crossings lie at that sample, and with them
// the vertices of the eight cells around it: a box of 12 triangles in one point.
TEST(StacksFail, VerticesFallTogetherWhereADensityIsExactlyOneHalf) {
  const StackField cross = stacks_where(9, 9, 9, [](int i, int j) {
    const int away = std::abs(i - 4) + std::abs(j - 4);
    if (away > 1) return Layers{{0, 9, kRock}};
    const float half = away == 0 ? 1.5F : 0.5F;
    return Layers{{0, 4.5F - half, kRock}, {4.5F + half, 9, kRock}};
  });
  const TriangleMesh mesh = surface_on(prepare(cross, filtered(1)), 0);
  EXPECT_EQ(without_area(mesh), 12);
  EXPECT_TRUE(finest_of(cross, filtered(1)).is_manifold());
  EXPECT_EQ(without_area(surface_on(prepare(cross, filtered(0)), 0)), 0);
}

// Where columns are rock or air for three voxels and more, a Gauss filter's densities are
// sixteenths, and many are a half; a box filter's are ninths, and none is.
TEST(StacksFail, SteepCavesHaveTrianglesWithoutArea) {
  const StackField caves =
      terrain::generate_stacks("generate:caves?size=65&spacing=30&relief=3000");
  Parameters box = filtered(1);
  box.filter.kernel = dual_contouring::Kernel::Box;
  EXPECT_EQ(without_area(surface_on(prepare(caves, filtered(1)), 0)), 1709);
  EXPECT_EQ(without_area(surface_on(prepare(caves, box), 0)), 0);
}

TEST(StacksFail, NotWhereAllIsAirOrAllIsRock) {
  const StackField air = stacks_where(20, 20, 16, [](int, int) { return Layers{}; });
  const StackField rock = stacks_where(20, 20, 16, [](int, int) { return Layers{{0, 16, kRock}}; });
  for (const Variant variant : kBoth) {
    for (int level = 0; level < 2; ++level) {
      EXPECT_TRUE(surface_on(prepare(air, filtered(1, variant)), level).triangles.empty());
      const auto check =
          check_stack_mesh(surface_on(prepare(rock, filtered(1, variant)), level), rock);
      EXPECT_TRUE(check.is_manifold());
      EXPECT_EQ(check.lowest_m, 16.0);
      EXPECT_EQ(check.highest_m, 16.0);
    }
  }
}

// A stack without a layer goes down for ever: a shaft of 2 x 2 columns ends open below the field,
// with two edges a side. One column alone the filter closes, but for a dent.
TEST(StacksFail, AShaftOfAirHasNoBottom) {
  const auto shaft = [](int columns) {
    return stacks_where(16, 16, 16, [&](int i, int j) {
      const bool is_air = i >= 8 && i < 8 + columns && j >= 8 && j < 8 + columns;
      return is_air ? Layers{} : Layers{{0, 12, kRock}};
    });
  };
  for (const Variant variant : kBoth) {
    EXPECT_TRUE(finest_of(shaft(1), filtered(1, variant)).is_manifold());
    EXPECT_GT(finest_of(shaft(1), filtered(1, variant)).lowest_m, 11.5);
    const StackMeshCheck open = finest_of(shaft(2), filtered(1, variant));
    EXPECT_EQ(open.open, 8);
    EXPECT_LT(open.lowest_m, 0.0);
  }
}

}  // namespace
}  // namespace plumb::mesh::stacks
