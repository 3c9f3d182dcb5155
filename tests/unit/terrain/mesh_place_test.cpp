// Whether a mesh lies where the terrain does.
#include "terrain/mesh_file.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

// 100 m x 100 m from (500000, 4500000) on.
Heightfield terrain() {
  Heightfield field;
  field.heights_m = Grid<float>(11, 11, 7.0f);
  field.dx_m = field.dy_m = 10.0;
  field.origin_m = {500000.0, 4500000.0};
  return field;
}

// Two corners of its box, relative to the mesh's origin.
TriangleMesh mesh(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& origin_m) {
  return {origin_m, {low, high, {high.x, low.y, low.z}}, {{0, 2, 1}}};
}

const glm::dvec3 kOrigin(500000, 4500000, 0);

TEST(MeshPlace, IsRightWhereTheBoxesOverlap) {
  EXPECT_FALSE(misplacement(mesh({0, 0, 0}, {100, 100, 9}, kOrigin), terrain()));
  EXPECT_FALSE(misplacement(mesh({-1e6, -1e6, 0}, {1e6, 1e6, 9}, kOrigin), terrain()));
  EXPECT_FALSE(misplacement(mesh({40, 40, 0}, {41, 41, 9}, kOrigin), terrain()));
  EXPECT_FALSE(
      misplacement(mesh({500000, 4500000, 0}, {500100, 4500100, 9}, {0, 0, 0}), terrain()));
}

TEST(MeshPlace, NamesBothBoxesOfAMeshThatLiesElsewhere) {
  const auto hint = misplacement(mesh({0, 0, 0}, {100, 100, 9}, {0, 0, 0}), terrain());
  ASSERT_TRUE(hint);
  for (const char* words :
       {"do not overlap", "the mesh lies at x 0 to 100, y 0 to 100",
        "the terrain at x 500000 to 500100, y 4500000 to 4500100", "--offset", "--up"})
    EXPECT_NE(hint->find(words), std::string::npos) << *hint;
  EXPECT_EQ(hint->find('\n'), std::string::npos);
}

// 10 m x 9.9 m of 100 m x 100 m are 0.99 %, 10 m x 10 m are 1 %.
TEST(MeshPlace, AsksForAHundredthOfTheSmallerBox) {
  const auto hint = misplacement(mesh({90, 90.1, 0}, {190, 190.1, 9}, kOrigin), terrain());
  ASSERT_TRUE(hint);
  EXPECT_NE(hint->find("overlap by 0.99 % of the smaller one"), std::string::npos) << *hint;
  EXPECT_FALSE(misplacement(mesh({90, 90, 0}, {190, 190, 9}, kOrigin), terrain()));
  EXPECT_TRUE(misplacement(mesh({100, 0, 0}, {200, 100, 9}, kOrigin), terrain()));  // side by side
}

// A box without an area lies in the other one or not.
TEST(MeshPlace, KnowsAWallFromAboveToo) {
  EXPECT_FALSE(misplacement(mesh({50, 0, 0}, {50, 100, 9}, kOrigin), terrain()));
  EXPECT_TRUE(misplacement(mesh({150, 0, 0}, {150, 100, 9}, kOrigin), terrain()));
}

// 500000 + 0.7 k in double, less 500000, is not 0.7 k.
TEST(MeshPlace, PutsVerticesOfSamplesWhereTheSamplesAre) {
  Heightfield field = terrain();
  field.dx_m = field.dy_m = 0.7;
  TriangleMesh full;
  int off = 0;
  for (int k = 0; k < 11; ++k) {
    full.vertices_m.emplace_back(500000.0 + k * 0.7, 4500000.0 + k * 0.7, 1.0);
    off += full.vertices_m.back().x - 500000.0 != k * 0.7 ? 1 : 0;
  }
  full.vertices_m.emplace_back(500000.7 + 1e-8, 4500000.3, 1.0);  // of no sample
  ASSERT_GT(off, 0);
  move_to_origin_of(field, full);
  EXPECT_EQ(full.origin_m, kOrigin);
  for (int k = 0; k < 11; ++k)
    EXPECT_EQ(full.vertices_m[static_cast<std::size_t>(k)], glm::dvec3(k * 0.7, k * 0.7, 1.0));
  EXPECT_EQ(full.vertices_m[11], glm::dvec3(500000.7 + 1e-8 - 500000.0, 4500000.3 - 4500000.0, 1));
}

TEST(MeshPlace, LeavesAMeshThatHasTheTerrainsOrigin) {
  TriangleMesh near = mesh({1e-15, 10 + 2e-15, 0}, {100, 100, 9}, kOrigin + glm::dvec3(0, 0, 5));
  const TriangleMesh before = near;
  move_to_origin_of(terrain(), near);
  EXPECT_EQ(near.vertices_m, before.vertices_m);
  EXPECT_EQ(near.origin_m, before.origin_m);
}

}  // namespace
}  // namespace plumb::terrain
