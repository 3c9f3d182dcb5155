// Voxels as stacks.
#include "terrain/stacks/stack_import_voxels.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/check.h"
#include "support/random_scene.h"
#include "support/run_command.h"

namespace plumb::terrain {
namespace {

using Indices = std::vector<std::uint8_t>;

// 2 x 1 columns of 4 voxels of half a metre from 10 m up: 1 1 0 2 and 0 0 0 0.
const Indices kIndices{1, 0, 1, 0, 0, 0, 2, 0};
VoxelGridShape small_shape() { return {2, 1, 4, 3.0, 3.0, 0.5, {7.0, 8.0}, 10.0F, {}}; }

std::string refusal(const Indices& indices, const VoxelGridShape& shape) {
  try {
    stacks_of_voxels(indices, shape);
  } catch (const InputError& error) {
    return error.what();
  }
  return "they were taken";
}

TEST(StackImportVoxels, MakesRunsLayers) {
  const StackField field = stacks_of_voxels(kIndices, small_shape());
  require_valid(field);
  EXPECT_EQ(layers_of(field, 0, 0),
            (std::vector<Layer>{{10.0F, 11.0F, 1}, {11.0F, 11.5F, 0}, {11.5F, 12.0F, 2}}));
  EXPECT_EQ(layers_of(field, 1, 0), (std::vector<Layer>{{10.0F, 12.0F, 0}}));
  ASSERT_EQ(field.materials.size(), 3u);
  EXPECT_EQ(field.materials[0].name, "air");
  EXPECT_EQ(field.materials[1].name, "material1");
  EXPECT_EQ(field.materials[2].name, "material2");
  EXPECT_EQ(field.origin_m, glm::dvec2(7.0, 8.0));
  VoxelGridShape named = small_shape();
  named.materials = {"rock"};
  EXPECT_EQ(stacks_of_voxels(kIndices, named).materials[1].name, "rock");
  EXPECT_EQ(stacks_of_voxels(kIndices, named).materials[2].name, "material2");
}

// Every voxel's middle is of its index, of all 256 of them.
TEST(StackImportVoxels, HasEachVoxelsMaterialAtItsMiddle) {
  test_support::Random random(3);
  const VoxelGridShape shape{7, 5, 40, 1.0, 1.0, 0.3, {0.0, 0.0}, -4.2F, {}};
  Indices indices(7 * 5 * 40);
  for (std::uint8_t& index : indices)
    index = static_cast<std::uint8_t>(random.chance(0.5) ? random.integer(0, 255)
                                                         : random.integer(0, 1));
  const StackField field = stacks_of_voxels(indices, shape);
  require_valid(field);
  for (int v = 0; v < 40; ++v) {
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 7; ++i)
        ASSERT_EQ(field.stack(i, j).at(static_cast<float>(-4.2 + (v + 0.5) * 0.3)),
                  indices[static_cast<std::size_t>(i + 7 * (j + 5 * v))]);
    }
  }
}

TEST(StackImportVoxels, RefusesOtherSizesInOneLine) {
  VoxelGridShape shape = small_shape();
  EXPECT_EQ(refusal(Indices(7), shape),
            "voxels: 2 x 1 x 4 voxels of a byte are 8 bytes, there are 7");
  shape.columns = 0;
  EXPECT_NE(refusal({}, shape).find("0 x 1 x 4"), std::string::npos);
  shape = small_shape();
  shape.dy_m = 0.0;
  EXPECT_NE(refusal(kIndices, shape).find("above zero"), std::string::npos);
  // At 2^24 m floats are a metre apart below and two above.
  shape = small_shape();
  shape.low_m = 16777000.0F;
  EXPECT_NE(refusal(kIndices, shape).find("single precision"), std::string::npos);
}

TEST(StackImportVoxels, ReadsABareFile) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.file("v.raw");
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(kIndices.data()), 8);
  StackField field = read_voxels(path, small_shape());
  EXPECT_EQ(checksum(field), checksum(stacks_of_voxels(kIndices, small_shape())));
  EXPECT_EQ(field.provenance.source, path);
  VoxelGridShape shape = small_shape();
  shape.voxels = 2147483647;
  EXPECT_THROW(read_voxels(path, shape), InputError);
  EXPECT_THROW(read_voxels(folder.file("none"), small_shape()), InputError);
}

}  // namespace
}  // namespace plumb::terrain
