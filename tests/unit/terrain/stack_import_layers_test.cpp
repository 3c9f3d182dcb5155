// Surfaces over each other as stacks.
#include "terrain/stacks/stack_import_layers.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/check.h"

namespace plumb::terrain {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

// Three samples from west to east.
MaterialSurface surface(const std::string& material, float a, float b, float c) {
  MaterialSurface result{material, {}};
  Grid<float> heights(3, 1);
  heights(0, 0) = a;
  heights(1, 0) = b;
  heights(2, 0) = c;
  result.top.heights_m = HeightGrid(std::move(heights));
  result.top.dx_m = result.top.dy_m = 2.0;
  result.top.provenance.source = material + ".tif";
  return result;
}

std::string refusal(const std::vector<MaterialSurface>& surfaces) {
  try {
    stacks_of_layers(surfaces);
  } catch (const InputError& error) {
    return error.what();
  }
  return "they were taken";
}

// Soil of 1 m, none where its surface lies 2 m below the rock's, and a hole where it is void.
TEST(StackImportLayers, LaysEachMaterialOnTheOneBefore) {
  const LayeredStacks result =
      stacks_of_layers(std::vector{surface("rock", 5, 8, 6), surface("soil", 6, 6, kVoid)});
  const StackField& field = result.field;
  require_valid(field);
  EXPECT_EQ(field.low_m, 2.0F);  // 5 m lie in voxel 4 to 6 of 2 m, and one more below
  EXPECT_EQ(field.high_m(), 10.0);
  EXPECT_EQ(layers_of(field, 0, 0),
            (std::vector<Layer>{{2.0F, 5.0F, 1}, {5.0F, 6.0F, 2}, {6.0F, 10.0F, 0}}));
  EXPECT_EQ(layers_of(field, 1, 0), (std::vector<Layer>{{2.0F, 8.0F, 1}, {8.0F, 10.0F, 0}}));
  EXPECT_TRUE(field.is_hole(2, 0));
  EXPECT_EQ(result.holes, 1);
  EXPECT_EQ(result.pinched, (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(result.deepest_pinch_m[1], 2.0);
  EXPECT_EQ(field.provenance.source, "rock=rock.tif + soil=soil.tif");
  ASSERT_EQ(field.provenance.assumptions.size(), 2u);
  EXPECT_EQ(field.provenance.assumptions[0],
            "layer 'soil' has no thickness at 1 of 3 stacks, where its surface lies on the one "
            "before or up to 2 m below");
}

// A bridge of half a metre, 4 m over the ground in the middle: the deck is of the ground's rock.
TEST(StackImportLayers, LeavesAGapForAir) {
  const LayeredStacks result = stacks_of_layers(
      std::vector{surface("rock", 1, 1, 1), surface("air", 1, 5, 1), surface("rock", 1, 5.5, 1)},
      1.0);
  EXPECT_EQ(result.field.materials.size(), 2u);
  EXPECT_EQ(result.pinched, (std::vector<std::int64_t>{0, 2, 2}));
  EXPECT_EQ(layers_of(result.field, 0, 0), (std::vector<Layer>{{0.0F, 1.0F, 1}, {1.0F, 6.0F, 0}}));
  EXPECT_EQ(
      layers_of(result.field, 1, 0),
      (std::vector<Layer>{{0.0F, 1.0F, 1}, {1.0F, 5.0F, 0}, {5.0F, 5.5F, 1}, {5.5F, 6.0F, 0}}));
}

TEST(StackImportLayers, NamesWhichSurfacesDifferAndByWhat) {
  const MaterialSurface rock = surface("rock", 1, 2, 3);
  MaterialSurface soil = surface("soil", 2, 3, 4);
  const auto refused = [&](const std::string& words) {
    const std::string line = refusal({rock, soil});
    EXPECT_NE(line.find(words), std::string::npos) << line;
    EXPECT_NE(line.find("layer 'soil' (soil.tif) and layer 'rock' (rock.tif)"), std::string::npos)
        << line;
    soil = surface("soil", 2, 3, 4);
  };
  soil.top.heights_m = HeightGrid(Grid<float>(3, 2));
  refused("got 3 x 2 and 3 x 1 samples");
  soil.top.dy_m = 2.5;
  refused("got 2 x 2.5 and 2 x 2 m");
  soil.top.origin_m = {0.5, -1.0};
  refused("lies 0.5 m east and -1 m north");
  soil.top.provenance.crs = "EPSG:2056";
  EXPECT_EQ(refusal({rock, soil}), "they were taken");  // the other states none
  MaterialSurface other = surface("rock", 1, 2, 3);
  other.top.provenance.crs = "EPSG:25832";
  EXPECT_NE(refusal({other, soil}).find("EPSG:2056 and EPSG:25832"), std::string::npos);
  // A ten-millionth of a cell is rounding.
  soil = surface("soil", 2, 3, 4);
  soil.top.origin_m.x = 2e-7;
  EXPECT_EQ(refusal({rock, soil}), "they were taken");
}

TEST(StackImportLayers, RefusesWhatIsNoLayer) {
  EXPECT_NE(refusal({}).find("need a layer"), std::string::npos);
  EXPECT_NE(refusal({surface("rock", kVoid, kVoid, kVoid)}).find("no height"), std::string::npos);
  EXPECT_NE(refusal({surface("rock", 1, 2, 3), surface("air", 2, 3, 4)}).find("topmost"),
            std::string::npos);
  EXPECT_NE(refusal({surface("", 1, 2, 3)}).find("name"), std::string::npos);
}

}  // namespace
}  // namespace plumb::terrain
