#include "terrain/stacks/stack_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/check.h"

namespace plumb::terrain {
namespace {

constexpr Material kRock = 1, kSand = 2;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Stacks from 10 to 18 m, voxels of 2 m.
StackField shape(int columns, int rows) {
  StackField field;
  field.columns = columns;
  field.rows = rows;
  field.voxel_m = 2.0;
  field.low_m = 10.0F;
  field.voxels = 4;
  field.materials = {{"air", glm::dvec3(0.0)}, {"rock"}, {"sand"}};
  return field;
}

StackField of_one_stack(const std::vector<Layer>& layers) {
  StackField field = shape(1, 1);
  StackWriter(field).add(layers);
  return field;
}

Heightfield heights_of(std::vector<float> heights_m) {
  Heightfield field;
  Grid<float> grid(static_cast<int>(heights_m.size()), 1);
  grid.values() = std::move(heights_m);
  field.heights_m = HeightGrid(std::move(grid));
  return field;
}

TEST(StackWriter, FillsGapsWithAir) {
  const StackField field = of_one_stack({{10, 12, kRock}, {13, 15, kRock}, {16, 17, kSand}});
  const std::vector<Layer> expected = {{10, 12, kRock}, {12, 13, kAir},  {13, 15, kRock},
                                       {15, 16, kAir},  {16, 17, kSand}, {17, 18, kAir}};
  EXPECT_EQ(layers_of(field, 0, 0), expected);
  EXPECT_EQ(field.end_m.size(), 5u);  // the air on top is not kept
  EXPECT_NO_THROW(require_valid(field));
}

TEST(StackWriter, BeginsWithAirWhereTheLowestLayerDoesNotReachTheBottom) {
  const std::vector<Layer> expected = {{10, 13, kAir}, {13, 15, kRock}, {15, 18, kAir}};
  EXPECT_EQ(layers_of(of_one_stack({{13, 15, kRock}}), 0, 0), expected);
}

TEST(StackWriter, JoinsNeighboursOfOneMaterial) {
  const std::vector<Layer> expected = {{10, 14, kRock}, {14, 18, kAir}};
  EXPECT_EQ(layers_of(of_one_stack({{10, 12, kRock}, {12, 14, kRock}}), 0, 0), expected);
}

TEST(StackWriter, LeavesOutLayersWithoutThickness) {
  const std::vector<Layer> expected = {{10, 14, kRock}, {14, 18, kAir}};
  EXPECT_EQ(
      layers_of(of_one_stack({{10, 12, kRock}, {12, 12, kSand}, {12, 14, kRock}, {16, 16, kSand}}),
                0, 0),
      expected);
}

TEST(StackWriter, TakesAirThatIsGiven) {
  const std::vector<Layer> expected = {
      {10, 12, kRock}, {12, 13, kAir}, {13, 14, kRock}, {14, 18, kAir}};
  EXPECT_EQ(layers_of(of_one_stack({{10, 12, kRock},
                                    {12, 12.5, kAir},
                                    {12.5, 13, kAir},
                                    {13, 14, kRock},
                                    {14, 18, kAir}}),
                      0, 0),
            expected);
}

TEST(StackWriter, CutsOffWhatLiesOutsideTheField) {
  const std::vector<Layer> expected = {{10, 12, kSand}, {12, 18, kRock}};
  EXPECT_EQ(
      layers_of(of_one_stack({{0, 9, kRock}, {9, 12, kSand}, {12, 30, kRock}, {30, 31, kSand}}), 0,
                0),
      expected);
}

TEST(StackWriter, WritesRowsFromWestToEast) {
  StackField field = shape(2, 2);
  StackWriter writer(field);
  for (const float end_m : {11.0F, 12.0F, 13.0F, 14.0F}) {
    const Layer layer{10, end_m, kRock};
    writer.add({&layer, 1});
  }
  EXPECT_EQ(field.stack(1, 0).end_m[0], 12.0F);
  EXPECT_EQ(field.stack(0, 1).end_m[0], 13.0F);
}

TEST(StackWriter, MarksHoles) {
  StackField field = shape(3, 1);
  StackWriter writer(field);
  const Layer layer{10, 12, kRock};
  writer.add({&layer, 1});
  writer.add_hole();
  writer.add({});
  EXPECT_FALSE(field.is_hole(0, 0));
  EXPECT_TRUE(field.is_hole(1, 0));
  EXPECT_FALSE(field.is_hole(2, 0));  // air, which is known
  EXPECT_NO_THROW(require_valid(field));
}

TEST(StackWriter, RefusesLayersThatDoNotFollowOneAnother) {
  StackField field = shape(1, 1);
  StackWriter writer(field);
  const auto refuses = [&](std::vector<Layer> layers) {
    EXPECT_THROW(writer.add(layers), std::invalid_argument);
  };
  refuses({{12, 11, kRock}});
  refuses({{10, 12, kRock}, {11, 13, kSand}});
  refuses({{10, kNone, kRock}});
  refuses({{-std::numeric_limits<float>::infinity(), 12, kRock}});
  refuses({{10, 12, 3}});
}

TEST(StackWriter, LeavesTheFieldAsItWasWhenItRefuses) {
  StackField field = shape(1, 1);
  StackWriter writer(field);
  const std::vector<Layer> good = {{10, 12, kRock}}, bad = {{10, 12, kSand}, {11, 13, kRock}};
  EXPECT_THROW(writer.add(bad), std::invalid_argument);
  writer.add(good);
  EXPECT_THROW(writer.add(good), std::invalid_argument);  // one stack is all there is
  EXPECT_THROW(writer.add_hole(), std::invalid_argument);
  EXPECT_EQ(checksum(field), checksum(of_one_stack(good)));
}

TEST(StackView, GivesTheEndOfALayerToTheLayerAbove) {
  const StackField field = of_one_stack({{10, 12, kRock}, {13, 15, kSand}});
  const StackView stack = field.stack(0, 0);
  EXPECT_EQ(stack.at(11.0F), kRock);
  EXPECT_EQ(stack.at(12.0F), kAir);
  EXPECT_EQ(stack.at(13.0F), kSand);
  EXPECT_EQ(stack.at(15.0F), kAir);
  EXPECT_EQ(stack.at(1000.0F), kAir);
}

TEST(StackView, GoesOnBelowTheField) {
  EXPECT_EQ(of_one_stack({{10, 12, kSand}}).stack(0, 0).at(-1000.0F), kSand);
  EXPECT_EQ(of_one_stack({{11, 12, kSand}}).stack(0, 0).at(-1000.0F), kAir);
  EXPECT_EQ(of_one_stack({}).stack(0, 0).at(-1000.0F), kAir);
}

TEST(StackField, EndsAtAFloatThatIsNotAboveIt) {
  StackField field = shape(1, 1);
  EXPECT_EQ(field.highest_m(), 18.0F);
  field.low_m = 0.0F;
  field.voxel_m = 0.1;  // 4 * 0.1 = 0.4, whose nearest float is 0.4000000060
  EXPECT_EQ(field.highest_m(), std::nextafter(0.4F, 0.0F));
}

TEST(StackField, CountsTheBytesOfItsArrays) {
  // 2 first layers of 4 bytes, 3 ends of 4 and 3 materials of 1.
  EXPECT_EQ(of_one_stack({{10, 12, kRock}, {13, 15, kSand}}).bytes(), 8u + 12u + 3u);
}

TEST(StacksOf, HasOneLayerOfRockUnderEachHeight) {
  const StackField field = stacks_of(heights_of({3.25F, kNone, 5.0F}));
  EXPECT_NO_THROW(require_valid(field));
  EXPECT_EQ(field.voxel_m, 1.0);
  EXPECT_EQ(field.low_m, 2.0F);    // a voxel or more below 3.25
  EXPECT_EQ(field.high_m(), 6.0);  // above 5
  const std::vector<Layer> expected = {{2, 3.25, kRock}, {3.25, 6, kAir}};
  EXPECT_EQ(layers_of(field, 0, 0), expected);
  EXPECT_TRUE(field.is_hole(1, 0));
  EXPECT_EQ(field.materials[kRock].name, "rock");
}

TEST(StacksOf, HasTheVoxelsThatAreAskedFor) {
  const StackField field = stacks_of(heights_of({-3.0F, 4.0F}), 0.5);
  EXPECT_EQ(field.low_m, -3.5F);
  EXPECT_EQ(field.voxels, 16);  // to 4.5
}

// 3 / 0.1 is 30, but 29 * 0.1 rounds to a float above 2.9; 1e7 - 1e-3 rounds to 1e7.
TEST(StacksOf, LeavesAVoxelBelowTheLowestHeightWhateverIsRounded) {
  for (const float height_m : {3.0F, 1e7F, -1e7F, 0.3F, 8.1F, 0.0F, 1e-30F}) {
    for (const double voxel_m : {0.1, 0.3, 1e-3, 0.7, 30.0}) {
      const StackField field = stacks_of(heights_of({height_m}), voxel_m);
      EXPECT_GE(static_cast<double>(height_m) - field.low_m, voxel_m) << height_m;
      EXPECT_GT(field.high_m(), height_m) << height_m << " " << voxel_m;
      EXPECT_EQ(field.stack(0, 0).end_m[0], height_m);
      EXPECT_NO_THROW(require_valid(field));
    }
  }
}

TEST(StacksOf, RefusesWhatHasNoVoxels) {
  EXPECT_THROW(stacks_of(heights_of({kNone})), InputError);
  EXPECT_THROW(stacks_of(heights_of({0.0F, 1.0F}), 1e-10), InputError);
  for (const double voxel_m : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(stacks_of(heights_of({0.0F}), voxel_m), std::invalid_argument);
}

TEST(TopSurface, IsTheHeightfieldThatStacksWereMadeOf) {
  Heightfield heights = heights_of({3.25F, kNone, 5.0F});
  heights.dx_m = 2.0;
  heights.origin_m = {7.0, 8.0};
  const Heightfield top = top_surface(stacks_of(heights));
  EXPECT_EQ(checksum(top), checksum(heights));
  EXPECT_EQ(top.provenance.assumptions.size(), 1u);
}

TEST(TopSurface, LiesOnTheHighestLayerAndAtTheBottomOfAir) {
  EXPECT_EQ(top_surface(of_one_stack({{10, 12, kRock}, {13, 15, kSand}})).heights_m(0, 0), 15.0F);
  EXPECT_EQ(top_surface(of_one_stack({})).heights_m(0, 0), 10.0F);
}

TEST(LayersOf, CoverEveryHeight) {
  const std::vector<Layer> air = {{10, 18, kAir}}, rock = {{10, 18, kRock}};
  EXPECT_EQ(layers_of(of_one_stack({}), 0, 0), air);
  EXPECT_EQ(layers_of(of_one_stack({{10, 18, kRock}}), 0, 0), rock);
}

TEST(Checksum, TellsStacksApart) {
  const std::uint64_t sum = checksum(of_one_stack({{10, 12, kRock}}));
  EXPECT_EQ(checksum(of_one_stack({{10, 12, kRock}})), sum);
  EXPECT_NE(checksum(of_one_stack({{10, 12, kSand}})), sum);
  EXPECT_NE(checksum(of_one_stack({{10, 12.5, kRock}})), sum);
  StackField other = of_one_stack({{10, 12, kRock}});
  other.materials[kSand].colour.x = 0.75;
  EXPECT_NE(checksum(other), sum);
}

TEST(RequireValid, NamesWhatMustHold) {
  const auto refuses = [](auto&& damage) {
    StackField field = of_one_stack({{10, 12, kRock}, {13, 15, kSand}});
    EXPECT_NO_THROW(require_valid(field));
    damage(field);
    EXPECT_THROW(require_valid(field), std::invalid_argument);
  };
  refuses([](StackField& f) { f.columns = 0; });
  refuses([](StackField& f) { f.voxels = 0; });
  refuses([](StackField& f) { f.voxels = 2; });  // up to 14 m, below the layers
  refuses([](StackField& f) { f.voxel_m = 0.0; });
  refuses([](StackField& f) { f.voxel_m = 1e-9; });  // no float between bottom and top
  refuses([](StackField& f) { f.dx_m = kNone; });
  refuses([](StackField& f) { f.low_m = kNone; });
  refuses([](StackField& f) { f.low_m = 12.0F; });
  refuses([](StackField& f) { f.origin_m.y = kNone; });
  refuses([](StackField& f) { f.materials.pop_back(); });
  refuses([](StackField& f) { f.materials.clear(); });
  refuses([](StackField& f) { f.materials.resize(257); });
  refuses([](StackField& f) { f.first_layer[1] = 2; });
  refuses([](StackField& f) { f.first_layer.push_back(3); });
  refuses([](StackField& f) { f.end_m[1] = 12.0F; });
  refuses([](StackField& f) { f.end_m[1] = kNone; });
  refuses([](StackField& f) { f.material[1] = kRock; });
  refuses([](StackField& f) { f.material[2] = kAir; });
  refuses([](StackField& f) { f.material.pop_back(); });
  refuses([](StackField& f) { f.holes = {1}; });
  refuses([](StackField& f) { f.holes = {0, 0}; });
}

}  // namespace
}  // namespace plumb::terrain
