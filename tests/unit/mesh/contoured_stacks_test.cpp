// From stacks to quads: what the filter and the lattice do to thin things.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/dual_contouring/density.h"
#include "mesh/dual_contouring/quadrangulate.h"
#include "mesh/dual_contouring/smoothing.h"

namespace plumb::mesh::dual_contouring {
namespace {

using terrain::Layer;

constexpr terrain::Material kRock = 1;

// Cubes of a metre, 16 columns each way from 0 to 16 m.
template <class LayersAt>
terrain::StackField field_of(const LayersAt& layers_at) {
  terrain::StackField field;
  field.columns = field.rows = 16;
  field.voxels = 16;
  field.materials = {{"air"}, {"rock"}};
  terrain::StackWriter writer(field);
  for (int j = 0; j < 16; ++j) {
    for (int i = 0; i < 16; ++i) {
      const std::vector<Layer> layers = layers_at(i, j);
      writer.add(layers);
    }
  }
  return field;
}

QuadMesh contour(const terrain::StackField& field, int radius) {
  return quadrangulate(
      smoothed(density_of(field, {glm::ivec3(-radius), glm::ivec3(16 + 2 * radius)}),
               {Kernel::Gauss, radius}));
}

double highest(const QuadMesh& mesh) {
  double z = 0.0;
  for (const glm::dvec3& at : mesh.position) z = std::max(z, at.z);
  return z;
}

// Samples stand in the middle of voxels: ground at 8 m lies at 7.5 of the lattice. With a part f of
// the top voxel covered, f > 1/2, the crossing lies 3/2 - 1/(2 f) - f too high: 0 at 1/2 and 1,
// most at sqrt(1/2); and as much too low below 1/2.
TEST(ContouredStacks, LieAtMostThreeHalvesMinusRootTwoOffTheGround) {
  double most = 0.0;
  for (int k = 0; k <= 64; ++k) {
    const float part = static_cast<float>(k) / 64;
    const QuadMesh mesh = contour(field_of([&](int, int) {
                                    return std::vector<Layer>{{0, 8 + part, kRock}};
                                  }),
                                  0);
    ASSERT_EQ(mesh.position.size(), 15u * 15);
    const double off = highest(mesh) - (7.5 + static_cast<double>(part));
    EXPECT_EQ(off == 0.0, k % 32 == 0) << k;
    most = std::max(most, std::abs(off));
  }
  EXPECT_LE(most, 1.5 - std::sqrt(2.0) + 0x1p-24);
  EXPECT_GT(most, 0.08);
}

TEST(ContouredStacks, HaveNoSurfaceWhereAllIsAirOrRock) {
  EXPECT_TRUE(contour(field_of([](int, int) { return std::vector<Layer>{}; }), 1).position.empty());
  const auto rock = [](int, int) { return std::vector<Layer>{{0, 16, kRock}}; };
  const Lattice<float> density = density_of(field_of(rock), {{0, 0, 0}, {16, 16, 16}});
  EXPECT_TRUE(quadrangulate(density).position.empty());
}

std::vector<Layer> wall(int i, int width) {
  return {{0, i >= 8 && i < 8 + width ? 12.0F : 4.0F, kRock}};
}

// The weights 1/4, 1/2, 1/4 leave exactly 1/2 of a wall one column wide, which is outside.
TEST(ContouredStacks, LoseAWallOneColumnWideToTheFilter) {
  const auto narrow = field_of([](int i, int) { return wall(i, 1); });
  EXPECT_GT(highest(contour(narrow, 0)), 11.0);
  EXPECT_LT(highest(contour(narrow, 1)), 5.0);
  EXPECT_GT(highest(contour(field_of([](int i, int) { return wall(i, 2); }), 1)), 11.0);
}

// A slab thinner than half a voxel is nowhere more than half of one.
TEST(ContouredStacks, LoseALayerThinnerThanHalfAVoxel) {
  const auto slab = [](float thickness) {
    return field_of([=](int, int) {
      return std::vector<Layer>{{0, 4, kRock}, {9.25F, 9.25F + thickness, kRock}};
    });
  };
  EXPECT_LT(highest(contour(slab(0.5F), 0)), 5.0);
  EXPECT_GT(highest(contour(slab(0.6F), 0)), 8.5);
}

// A roof of one voxel over a cave: exactly 1/2 after the filter, so it opens.
TEST(ContouredStacks, LoseARoofThinnerThanTheFilter) {
  const auto roof = [](float thickness) {
    return field_of([=](int i, int j) {
      const bool over_cave = i > 3 && i < 12 && j > 3 && j < 12;
      return over_cave ? std::vector<Layer>{{0, 4, kRock}, {12 - thickness, 12, kRock}}
                       : std::vector<Layer>{{0, 12, kRock}};
    });
  };
  const auto ceiling = [](const QuadMesh& mesh) {
    int found = 0;
    for (const glm::dvec3& at : mesh.position)
      found += std::abs(at.x - 7.5) < 2 && std::abs(at.y - 7.5) < 2 && at.z > 8 ? 1 : 0;
    return found;
  };
  EXPECT_EQ(ceiling(contour(roof(1), 1)), 0);
  EXPECT_GT(ceiling(contour(roof(2), 1)), 0);
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
