#include "terrain/stacks/caves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/check.h"
#include "core/parallel.h"
#include "terrain/stacks/stack_source.h"
#include "terrain/terrain_source.h"

namespace plumb::terrain {
namespace {

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

void expect_says(const std::string& message, const std::string& words) {
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

/// How often a stack's ground begins, from the bottom up.
int grounds_of(const StackView& stack) {
  int grounds = 0;
  for (std::size_t k = 0; k < stack.size(); ++k)
    grounds += stack.material[k] != kAir && (k == 0 || stack.material[k - 1] == kAir) ? 1 : 0;
  return grounds;
}

/// The part of a field's stacks that have ground, air and ground again.
double part_with_air_below(const StackField& field) {
  int found = 0;
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i) found += grounds_of(field.stack(i, j)) > 1 ? 1 : 0;
  return found / static_cast<double>(field.size());
}

TEST(Caves, StandsAsItsParametersSay) {
  const StackField field =
      generate_stacks("generate:caves?size=30x20&spacing=2,4&relief=100&height=50&origin=7,8");
  EXPECT_EQ(field.columns, 30);
  EXPECT_EQ(field.rows, 20);
  EXPECT_EQ(field.voxel_m, 3.0);
  EXPECT_EQ(field.voxels, 34);  // 102 m
  EXPECT_EQ(field.low_m, 50.0F);
  EXPECT_EQ(field.origin_m, glm::dvec2(7.0, 8.0));
  EXPECT_NO_THROW(require_valid(field));
}

TEST(Caves, BeginsWithRockAndEndsWithinItsRelief) {
  const StackField field = generate_stacks("generate:caves?size=200&height=50&spacing=4");
  std::set<Material> materials;
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const StackView stack = field.stack(i, j);
      ASSERT_EQ(field.materials[stack.material[0]].name, "rock");
      ASSERT_GE(stack.end_m.back(), 50.0F + 0.05F * 128.0F - 1e-5F);  // a float near 56 m
      ASSERT_LE(stack.end_m.back(), 50.0F + 0.985F * 128.0F + 1e-5F);
      materials.insert(stack.material.begin(), stack.material.end());
    }
  }
  EXPECT_EQ(materials.size(), 5u);  // air, rock, sandstone, limestone, soil
}

TEST(Caves, HasCavesAndOverhangs) {
  EXPECT_GT(part_with_air_below(generate_stacks("generate:caves?spacing=4&size=257")), 0.15);
  // Without tunnels overhangs remain.
  const double overhangs =
      part_with_air_below(generate_stacks("generate:caves?spacing=4&size=257&caves=0"));
  EXPECT_GT(overhangs, 0.01);
  EXPECT_LT(overhangs, 0.1);
}

// A step of a quarter of a voxel finds what a look at every sample finds.
TEST(Caves, AreWhatTheDensitySaysAtEverySample) {
  const std::string argument = "generate:caves?size=24&spacing=9&seed=3&soil=0";
  const GeneratorValues values(argument);
  const Caves caves(values, values.shape());
  const StackField field = generate_stacks(argument);
  int solid = 0;
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      for (int k = 0; k < 4 * field.voxels; ++k) {
        const double height_m = 0.25 * k * field.voxel_m;
        const bool is_solid = caves.is_solid(i, j, height_m);
        ASSERT_EQ(field.stack(i, j).at(static_cast<float>(height_m)) != kAir, is_solid)
            << i << " " << j << " " << height_m;
        solid += is_solid ? 1 : 0;
      }
    }
  }
  EXPECT_GT(solid, 0);
}

// An end is the middle of the last of twelve halves of a quarter voxel of 9 m: within 2^-15 voxels
// of a change of sign, and half a unit of a float below 128 m.
TEST(Caves, EndWhereTheDensityChangesItsSign) {
  const std::string argument = "generate:caves?size=24&spacing=9&seed=3&soil=0";
  const GeneratorValues values(argument);
  const Caves caves(values, values.shape());
  const StackField field = generate_stacks(argument);
  const double near_m = 9.0 * 0x1p-15 * 1.001 + 0x1p-18;
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const StackView stack = field.stack(i, j);
      for (std::size_t k = 0; k < stack.size(); ++k) {
        const bool is_air = stack.material[k] == kAir;
        if (k + 1 < stack.size() && is_air == (stack.material[k + 1] == kAir)) continue;
        ASSERT_EQ(caves.is_solid(i, j, stack.end_m[k] - near_m), !is_air);
        ASSERT_EQ(caves.is_solid(i, j, stack.end_m[k] + near_m), is_air);
      }
    }
  }
}

TEST(Caves, HasSoilOnWhatFacesUpOnly) {
  const StackField field = generate_stacks("generate:caves?size=100&spacing=8&soil=3");
  int found = 0;
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const StackView stack = field.stack(i, j);
      for (std::size_t k = 0; k < stack.size(); ++k) {
        if (field.materials[stack.material[k]].name != "soil") continue;
        ++found;
        ASSERT_TRUE(k + 1 == stack.size() || stack.material[k + 1] == kAir);
        ASSERT_LE(stack.end_m[k] - stack.start_m(k), 3.0F + 1e-4F);  // of floats below 128 m
      }
    }
  }
  EXPECT_GT(found, 5000);
}

TEST(Caves, OfASmallerTerrainAreTheCornerOfALargerOne) {
  const StackField small = generate_stacks("generate:caves?size=17x9&seed=3&spacing=8");
  const StackField large = generate_stacks("generate:caves?size=40&seed=3&spacing=8");
  for (int j = 0; j < small.rows; ++j)
    for (int i = 0; i < small.columns; ++i)
      ASSERT_EQ(layers_of(small, i, j), layers_of(large, i, j));
}

TEST(Caves, AreTheSameOnAnyNumberOfThreads) {
  std::set<std::uint64_t> sums;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    sums.insert(checksum(generate_stacks("generate:caves?size=90x70&voids=0.1&seed=5")));
  }
  EXPECT_EQ(sums.size(), 1u);
}

// The bits of the generator are part of golden images: these change with its version only.
TEST(Caves, KeepTheirBits) {
  EXPECT_EQ(checksum(generate_stacks("generate:caves?size=65&spacing=6&seed=7")),
            8468952351002391580u);
}

TEST(Caves, TakeAnyScale) {
  for (const char* query : {"relief=0.001", "relief=1e5&spacing=10", "spacing=1e6",
                            "spacing=1e-3&relief=2", "feature=0.001", "caves=3", "soil=1e7",
                            "soil=0", "height=-1e7", "seed=9223372036854775807"}) {
    const StackField field = generate_stacks(std::string("generate:caves?size=3&") + query);
    EXPECT_NO_THROW(require_valid(field)) << query;
  }
}

TEST(Caves, HaveHolesWhereVoidsAreAskedFor) {
  const StackField field = generate_stacks("generate:caves?size=60&voids=0.3");
  std::int64_t holes = 0;
  for (const std::uint8_t hole : field.holes) holes += hole;
  EXPECT_EQ(holes, field.provenance.voids_declared);
  EXPECT_LE(holes, 1080);
  EXPECT_GE(holes, 1062);  // less by what one of 65536 levels holds, at most 0.5 % of the samples
}

TEST(StackSource, GivesTheSameStacksAgain) {
  const StackField field = generate_stacks("generate:caves?size=31x17&seed=4&relief=90");
  expect_says(field.provenance.source, "seed=4");
  EXPECT_EQ(checksum(field), checksum(generate_stacks(field.provenance.source)));
}

TEST(StackSource, KnowsItsNames) {
  for (const char* name :
       {"generate:caves", "generate:caves?size=3", "generate:caves?surface=stacks"})
    EXPECT_TRUE(is_stack_generator(name)) << name;
  for (const char* name : {"caves", "generate:caverns", "generate:cave", "generate:alpine",
                           "generate:caves?surface=top", "generate:caves?size=3&surface=top", ""})
    EXPECT_FALSE(is_stack_generator(name)) << name;
}

TEST(StackSource, TopOfStacksIsATerrainOfHeights) {
  const std::string argument = "generate:caves?size=40x30&spacing=5&voids=0.1&utm=1";
  const Heightfield top = load_terrain(argument + "&surface=top");
  EXPECT_EQ(checksum(top), checksum(top_surface(generate_stacks(argument))));
  EXPECT_EQ(checksum(top), checksum(generate(top.provenance.source)));
  EXPECT_GT(top.provenance.voids_declared, 0);
}

TEST(StackSource, RefusesStacksWhereHeightsAreAskedFor) {
  expect_says(refusal([] { generate("generate:caves?size=9"); }),
              "generate:caves: caves is a terrain of stacks: method stacks draws it; surface=top");
  expect_says(refusal([] { load_terrain("generate:caves?surface=bottom"); }), "stacks or top");
  expect_says(refusal([] { generate_stacks("generate:caves?surface=top"); }),
              "surface 'top': expected stacks");
  expect_says(refusal([] { generate_stacks("generate:alpine"); }), "expected one of stacks: caves");
}

// A terrain of stacks is the heights of its top surface, with the stacks at hand.
TEST(StackSource, IsATerrainWithItsStacks) {
  const Heightfield field = load_terrain("generate:caves?size=9");
  ASSERT_NE(field.stacks, nullptr);
  EXPECT_EQ(checksum(*field.stacks), checksum(generate_stacks("generate:caves?size=9")));
  EXPECT_EQ(field.heights_m, top_surface(*field.stacks).heights_m);
  ReadOptions top;
  top.top_surface = true;
  EXPECT_EQ(load_terrain("generate:caves?size=9", top).stacks, nullptr);
  EXPECT_EQ(load_terrain("generate:caves?size=9&surface=top").stacks, nullptr);
}

TEST(StackSource, RefusesWhatDoesNotFit) {
  expect_says(refusal([] { generate_stacks("generate:caves?size=2000000"); }), "bytes of memory");
  expect_says(refusal([] { generate_stacks("generate:caves?relief=1e6&spacing=1"); }),
              "relief '1e6': expected at most 65536 voxels of 1 m");
  expect_says(refusal([] { generate_stacks("generate:caves?height=1e7&spacing=1e-4&relief=0.1"); }),
              "one at which floats tell voxels apart");
  expect_says(refusal([] { generate_stacks("generate:caves?relief=0"); }), "relief '0'");
  expect_says(refusal([] { generate_stacks("generate:caves?caves=4"); }), "caves '4'");
}

}  // namespace
}  // namespace plumb::terrain
