#include "terrain/stacks/stack_pyramid.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "support/drawn_stacks.h"
#include "terrain/stacks/stack_rows.h"

namespace plumb::terrain {
namespace {

using test_support::written_stacks;

TEST(StackPyramid, DoublesSpacingsAndHalvesSizesRoundedUp) {
  StackField field = written_stacks(3, std::vector<std::string>(15, "rrr.."));
  field.dx_m = 3.0;
  field.dy_m = 5.0;
  field.origin_m = {100.0, 200.0};
  const StackField half = halved(field);
  EXPECT_EQ(half.columns, 2);
  EXPECT_EQ(half.rows, 3);
  EXPECT_EQ(half.voxels, 3);  // of 2 m: one metre more than the 5 below
  EXPECT_EQ(half.dx_m, 6.0);
  EXPECT_EQ(half.dy_m, 10.0);
  EXPECT_EQ(half.voxel_m, 2.0);
  EXPECT_EQ(half.low_m, 0.0F);
  EXPECT_EQ(half.origin_m, glm::dvec2(101.5, 202.5));  // between the first two of each axis
  EXPECT_EQ(half.materials, field.materials);
}

// A stack of level L stands over the middle of 2^L x 2^L stacks: (2^L - 1) / 2 spacings in.
TEST(StackPyramid, StandsInTheMiddle) {
  const auto pyramid = stack_pyramid(written_stacks(8, std::vector<std::string>(64, "r.")), 4);
  ASSERT_EQ(pyramid.size(), 4u);
  EXPECT_EQ(pyramid[0].origin_m, glm::dvec2(0.0));
  EXPECT_EQ(pyramid[3].origin_m, glm::dvec2(3.5));
  EXPECT_EQ(pyramid[3].size(), 1u);
}

TEST(StackPyramid, KeepsHeightsExact) {
  StackField field = test_support::empty_stacks(2, 2, 4);
  const std::vector<Layer> layers = {{0.0F, 0.1F, 1}, {0.7F, 1.3F, 2}};
  StackWriter writer(field);
  for (int k = 0; k < 4; ++k) writer.add(layers);
  for (const StackField& level : stack_pyramid(field, 31)) {
    EXPECT_EQ(level.stack(0, 0).end_m[0], 0.1F);
    EXPECT_EQ(level.stack(0, 0).end_m[1], 0.7F);
    EXPECT_EQ(level.stack(0, 0).end_m[2], 1.3F);
    EXPECT_NO_THROW(require_valid(level));
  }
}

// Two rows of rock up to the top, two of air. Level 1 has voxels up to 4 m, of which the topmost
// reaches above all stacks: no air there votes for air, and of equal ones rock fills.
TEST(StackPyramid, HasOneIntervalOfHeightsOnAllLevels) {
  std::vector<std::string> rows(8, "rrr");
  rows.resize(16, "...");
  const auto pyramid = stack_pyramid(written_stacks(4, rows), 3);
  EXPECT_EQ(pyramid[1].voxels, 2);
  EXPECT_EQ(pyramid[2].stack(0, 0).end_m[0], 3.0F);
  EXPECT_EQ(pyramid[2].stack(0, 0).material[0], pyramid[0].stack(0, 0).material[0]);
}

TEST(StackPyramid, CountsTheBorderTwice) {
  // The third column has no neighbour: its two stacks count twice each, a tie of rock and air
  // between 1 and 3 m.
  const StackField half = halved(written_stacks(3, {"rrrr.", "rrrr.", "r....",  //
                                                    "rrrr.", "rrrr.", "rrr.."}));
  EXPECT_EQ(half.stack(0, 0).end_m[0], 4.0F);
  EXPECT_EQ(half.stack(1, 0).end_m[0], 2.0F);
}

TEST(StackPyramid, LeavesHolesOut) {
  // Of three stacks with 1, 2 and 3 m of rock the middle one.
  const StackField three = halved(written_stacks(2, {"r...", "rrr.", "", "rr.."}));
  EXPECT_FALSE(three.is_hole(0, 0));
  EXPECT_EQ(three.stack(0, 0).end_m[0], 2.0F);
  EXPECT_EQ(halved(written_stacks(2, {"", "", "", "rrr."})).stack(0, 0).end_m[0], 3.0F);
}

TEST(StackPyramid, FourHolesAreAHole) {
  const StackField half = halved(written_stacks(4, {"", "", "r.", "r.", "", "", "r.", ""}));
  EXPECT_TRUE(half.is_hole(0, 0));
  EXPECT_FALSE(half.is_hole(1, 0));
  EXPECT_NO_THROW(require_valid(half));
}

TEST(StackPyramid, IsTheSameOnAnyNumberOfThreads) {
  test_support::Draws draws(71);
  StackField field = test_support::empty_stacks(61, 43, 16);
  StackWriter writer(field);
  for (int k = 0; k < 61 * 43; ++k) {
    if (draws.whole(0, 9) == 0) {
      writer.add_hole();
    } else {
      writer.add(test_support::drawn_layers(draws, 16, 4, 6));
    }
  }
  std::vector<std::uint64_t> sums;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    const auto pyramid = stack_pyramid(field, 5);
    for (const StackField& level : pyramid) EXPECT_NO_THROW(require_valid(level));
    sums.push_back(checksum(pyramid[1]) ^ checksum(pyramid.back()));
  }
  EXPECT_EQ(sums[1], sums[0]);
  EXPECT_EQ(sums[2], sums[0]);
}

TEST(FieldOfRows, RefusesARowThatIsNotFilled) {
  const StackField shape = test_support::empty_stacks(2, 3, 4);
  const auto filled_up_to = [&](int last) {
    return field_of_rows(shape, [last](int j, StackWriter& row) {
      row.add({});
      if (j != last) row.add({});
    });
  };
  EXPECT_NO_THROW(require_valid(filled_up_to(3)));
  EXPECT_THROW(filled_up_to(2), std::invalid_argument);
}

TEST(FieldOfRows, JoinsRowsInTheirOrder) {
  const StackField field =
      field_of_rows(test_support::empty_stacks(2, 3, 4), [](int j, StackWriter& row) {
        const Layer layer{0.0F, 1.0F + static_cast<float>(j), 1};
        row.add({&layer, 1});
        j == 1 ? row.add_hole() : row.add({});
      });
  EXPECT_NO_THROW(require_valid(field));
  for (int j = 0; j < 3; ++j) {
    ASSERT_EQ(field.stack(0, j).size(), 1u);
    EXPECT_EQ(field.stack(0, j).end_m[0], 1.0F + static_cast<float>(j));
    EXPECT_EQ(field.stack(1, j).size(), 0u);
    EXPECT_EQ(field.is_hole(1, j), j == 1);
  }
}

TEST(StackPyramid, HasOneToThirtyOneLevels) {
  const StackField field = written_stacks(1, {"r."});
  EXPECT_EQ(stack_pyramid(field, 1).size(), 1u);
  EXPECT_THROW(stack_pyramid(field, 0), std::invalid_argument);
  EXPECT_THROW(stack_pyramid(field, 32), std::invalid_argument);
  StackField damaged = field;
  damaged.material[0] = kAir;
  EXPECT_THROW(stack_pyramid(damaged, 2), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::terrain
