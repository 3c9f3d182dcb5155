// Densities of boxes of stacks: short cuts that change nothing.
#include "mesh/stacks/stack_densities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "support/drawn_stacks.h"

namespace plumb::mesh::stacks {
namespace {

using dual_contouring::Filter;
using dual_contouring::Kernel;
using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

// From the bottom up rock, a cave, sand and lime: 8 x 8 stacks, of 40 m.
terrain::StackField layered() {
  return test_support::written_stacks(
      8, std::vector<std::string>(64, "rrrrrrrrrr..........ssssssssssllllll...."));
}

TEST(StackDensities, AreWholeWhereOneLayerReachesPastTheFilter) {
  const StackDensities densities(layered(), {Kernel::Gauss, 1});
  const auto values = [&](int z) { return densities(0, {{0, 0, z}, {2, 2, 1}}).values(); };
  EXPECT_EQ(values(-50), std::vector<float>(4, 1.0F));
  EXPECT_EQ(values(8), std::vector<float>(4, 1.0F));
  EXPECT_EQ(values(9), std::vector<float>(4, 0.75F));
  EXPECT_EQ(values(10), std::vector<float>(4, 0.25F));
  EXPECT_EQ(values(15), std::vector<float>(4, 0.0F));
  EXPECT_EQ(values(30), std::vector<float>(4, 1.0F));
  EXPECT_EQ(values(36), std::vector<float>(4, 0.25F));
  EXPECT_EQ(values(90), std::vector<float>(4, 0.0F));
}

// Sand from 20 to 30 m, lime to 36 m.
TEST(StackDensities, NameTheMaterialsNearABox) {
  const StackDensities densities(layered(), {Kernel::Gauss, 1});
  const auto materials = [&](int low, int high) {
    return densities.materials_in(0, {{0, 0, low}, {3, 3, high - low}});
  };
  using Materials = std::vector<terrain::Material>;
  EXPECT_EQ(materials(-9, -5), Materials({1}));
  EXPECT_EQ(materials(2, 5), Materials({1}));
  EXPECT_EQ(materials(13, 16), Materials());
  EXPECT_EQ(materials(0, 24), Materials({1, 2}));
  EXPECT_EQ(materials(26, 33), Materials({2, 3}));
  EXPECT_EQ(materials(40, 50), Materials());
}

TEST(StackDensities, RefuseAFilterThatIsTooWide) {
  EXPECT_THROW(StackDensities(layered(), {Kernel::Gauss, 5}), std::invalid_argument);
}

// Stacks of one to four thick layers, holes among them.
terrain::StackField drawn_field(test_support::Draws& draws) {
  terrain::StackField field =
      test_support::empty_stacks(draws.whole(5, 30), draws.whole(5, 30), 40);
  field.voxel_m = 0.3 * draws.whole(2, 5);
  field.voxels = static_cast<int>(40 / field.voxel_m) + 1;
  terrain::StackWriter writer(field);
  const auto usual = test_support::drawn_layers(draws, 40, 5, 4);
  for (std::size_t k = 0; k < field.size(); ++k) {
    if (k > 0 && draws.whole(0, 19) == 0)
      writer.add_hole();
    else
      writer.add(draws.whole(0, 9) == 0 ? test_support::drawn_layers(draws, 40, 5, 4) : usual);
  }
  return field;
}

TEST(StackDensities, AreThoseOfTheirStagesInEveryBox) {
  test_support::Draws draws(11);
  int uniform = 0, left_out = 0;
  for (int round = 0; round < 40; ++round) {
    const terrain::StackField field = drawn_field(draws);
    const Filter filter{Kernel::Gauss, draws.whole(0, 3)};
    const StackDensities densities(field, filter);
    for (int k = 0; k < 25; ++k) {
      const LatticeBox box{{draws.whole(-5, 30), draws.whole(-5, 30), draws.whole(-9, 70)},
                           {draws.whole(1, 5), draws.whole(1, 5), draws.whole(1, 9)}};
      const LatticeBox wide = box.grown(filter.radius);
      const Lattice<float> expected =
          dual_contouring::smoothed(dual_contouring::density_of(field, wide), filter);
      ASSERT_EQ(densities(0, box), expected) << round << " " << k;
      const auto [least, most] =
          std::minmax_element(expected.values().begin(), expected.values().end());
      uniform += *least == *most ? 1 : 0;
      const auto present = densities.materials_in(0, box);
      for (terrain::Material m = 1; m < 5; ++m) {
        if (std::find(present.begin(), present.end(), m) != present.end()) continue;
        ++left_out;
        ASSERT_EQ(densities.of_material(0, m, box), Lattice<float>(box)) << round << " " << k;
      }
    }
  }
  EXPECT_GT(uniform, 300);
  EXPECT_GT(left_out, 1000);
}

}  // namespace
}  // namespace plumb::mesh::stacks
