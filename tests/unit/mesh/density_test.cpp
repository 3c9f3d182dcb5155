// Coverage of voxels by stacks that can be added up by head.
#include "mesh/dual_contouring/density.h"

#include <gtest/gtest.h>

namespace plumb::mesh::dual_contouring {
namespace {

using terrain::Layer;
using terrain::Material;
using terrain::StackField;
using terrain::StackWriter;

constexpr Material kRock = 1, kSand = 2;

// Voxels of two metres from 10 m up; a stack without layers of its own is a hole.
StackField field_of(int columns, int rows, const std::vector<std::vector<Layer>>& stacks) {
  StackField field;
  field.columns = columns;
  field.rows = rows;
  field.voxel_m = 2.0;
  field.low_m = 10.0F;
  field.voxels = 4;
  field.materials = {{"air"}, {"rock"}, {"sand"}};
  StackWriter writer(field);
  for (const auto& layers : stacks) {
    if (layers.empty())
      writer.add_hole();
    else
      writer.add(layers);
  }
  return field;
}

// Voxels low to low + count of one column.
std::vector<float> column(const StackField& field, int i, int j, int low, int count) {
  return density_of(field, {{i, j, low}, {1, 1, count}}).values();
}

std::vector<float> column(const std::vector<Layer>& layers, int low, int count) {
  return column(field_of(1, 1, {layers}), 0, 0, low, count);
}

// Three metres of rock: a whole voxel and half of the next.
TEST(Density, CoversTheLastVoxelInPart) {
  EXPECT_EQ(column({{10, 13, kRock}}, 0, 4), (std::vector<float>{1, 0.5F, 0, 0}));
}

// Below the field the lowest layer goes on, above it is air.
TEST(Density, GoesOnBelowTheField) {
  EXPECT_EQ(column({{10, 11, kRock}}, -2, 7), (std::vector<float>{1, 1, 0.5F, 0, 0, 0, 0}));
  EXPECT_EQ(column({{11, 12, kRock}}, -1, 3), (std::vector<float>{0, 0.5F, 0}));
}

TEST(Density, IsZeroForAStackOfAir) {
  EXPECT_EQ(column({{10, 18, terrain::kAir}}, -1, 6), std::vector<float>(6, 0.0F));
}

TEST(Density, IsOneForAStackOfRock) {
  EXPECT_EQ(column({{10, 18, kRock}}, 0, 5), (std::vector<float>{1, 1, 1, 1, 0}));
}

// A slab of half a metre, and two in one voxel: 1/4 each.
TEST(Density, AddsUpThinLayers) {
  EXPECT_EQ(column({{12.5F, 13, kRock}}, 0, 3), (std::vector<float>{0, 0.25F, 0}));
  EXPECT_EQ(column({{12.25F, 12.75F, kRock}, {13, 13.5F, kSand}}, 0, 3),
            (std::vector<float>{0, 0.5F, 0}));
}

// A cave from 13 to 15.5 m.
TEST(Density, LeavesACaveEmpty) {
  EXPECT_EQ(column({{10, 13, kRock}, {15.5F, 17, kSand}}, 0, 4),
            (std::vector<float>{1, 0.5F, 0.25F, 0.5F}));
}

TEST(Density, DoesNotSeeTheBorderBetweenTwoMaterials) {
  EXPECT_EQ(column({{10, 11.3F, kRock}, {11.3F, 15.7F, kSand}}, 0, 4),
            column({{10, 15.7F, kRock}}, 0, 4));
}

TEST(Density, GoesOnBesideTheField) {
  const StackField field = field_of(2, 1, {{{10, 12, kRock}}, {{10, 15, kRock}}});
  EXPECT_EQ(column(field, -3, 5, 0, 3), (std::vector<float>{1, 0, 0}));
  EXPECT_EQ(column(field, 9, -2, 0, 3), (std::vector<float>{1, 1, 0.5F}));
}

// 19 columns, more than are filled side by side.
TEST(Density, IsTheSameInEveryBox) {
  std::vector<std::vector<Layer>> stacks;
  for (int s = 0; s < 19 * 3; ++s) {
    const float end_m = 10.5F + 0.1F * static_cast<float>(s);
    stacks.push_back({{10, end_m, kRock}, {end_m + 0.3F, end_m + 0.9F, kSand}});
  }
  const StackField field = field_of(19, 3, stacks);
  const Lattice<float> whole = density_of(field, {{-2, -1, -1}, {23, 5, 6}});
  for (const LatticeBox& box : {LatticeBox{{0, 0, 0}, {17, 2, 3}}, {{5, 1, 2}, {1, 1, 1}}}) {
    const Lattice<float> part = density_of(field, box);
    for (std::size_t k = 0; k < box.count(); ++k) EXPECT_EQ(part.values()[k], whole(box.at(k)));
  }
}

TEST(Density, IsEmptyInAnEmptyBox) {
  EXPECT_TRUE(
      density_of(field_of(1, 1, {{{10, 12, kRock}}}), {{0, 0, 0}, {3, 0, 2}}).values().empty());
}

TEST(MaterialDensity, CountsOneMaterial) {
  const StackField field = field_of(1, 1, {{{10, 13, kRock}, {13, 15.5F, kSand}}});
  const LatticeBox box{{0, 0, -1}, {1, 1, 4}};
  EXPECT_EQ(material_density_of(field, kRock, box).values(), (std::vector<float>{1, 1, 0.5F, 0}));
  EXPECT_EQ(material_density_of(field, kSand, box).values(),
            (std::vector<float>{0, 0, 0.5F, 0.75F}));
}

TEST(MaterialDensity, RefusesAirAndStrangers) {
  const StackField field = field_of(1, 1, {{{10, 13, kRock}}});
  EXPECT_THROW(material_density_of(field, terrain::kAir, {{}, {1, 1, 1}}), std::invalid_argument);
  EXPECT_THROW(material_density_of(field, 3, {{}, {1, 1, 1}}), std::invalid_argument);
}

// Five columns, three rows, the lowest first; o is a hole.
std::size_t stand_in(const std::string& map, int i, int j) {
  std::vector<std::vector<Layer>> stacks;
  for (const char c : map)
    stacks.push_back(c == 'o' ? std::vector<Layer>{} : std::vector<Layer>{{10, 12, kRock}});
  return NearestStacks(field_of(5, 3, stacks)).at(i, j);
}

TEST(NearestStacks, AreTheStacksThemselvesWhereThereIsNoHole) {
  EXPECT_EQ(stand_in("...............", 3, 1), 8u);
  EXPECT_EQ(stand_in(".oooo..........", 3, 1), 8u);
  EXPECT_EQ(stand_in("...............", 9, -4), 4u);
}

TEST(NearestStacks, AreTheLowestRowThenTheLowestColumnOfSeveral) {
  EXPECT_EQ(stand_in("ooooo"
                     "o.o.o"
                     "ooooo",
                     2, 1),
            6u);  // left and right alike
  EXPECT_EQ(stand_in("oo.oo"
                     "o.o.o"
                     "oo.oo",
                     2, 1),
            2u);  // the row below before all
  EXPECT_EQ(stand_in("ooooo"
                     "ooo.o"
                     ".oooo",
                     1, 1),
            10u);  // a diagonal step before two columns
  EXPECT_EQ(stand_in(".oooo"
                     "ooooo"
                     "oo.oo",
                     2, 0),
            0u);  // two columns away before two rows above
}

TEST(NearestStacks, RefuseAFieldOfHoles) {
  EXPECT_THROW(NearestStacks(field_of(2, 1, {{}, {}})), std::invalid_argument);
}

TEST(Density, FillsAHoleFromItsNearestStack) {
  const StackField field = field_of(3, 1, {{{10, 12, kRock}}, {{10, 15, kRock}}, {}});
  EXPECT_EQ(column(field, 2, 0, 0, 3), (std::vector<float>{1, 1, 0.5F}));
  EXPECT_EQ(column(field, 5, 0, 0, 3), (std::vector<float>{1, 1, 0.5F}));
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
