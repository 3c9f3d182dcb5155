#include "terrain/stacks/stack_aggregation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/drawn_stacks.h"

namespace plumb::terrain {
namespace {

using test_support::written_stacks;

struct Result {
  std::string layers;  // one letter a metre, as in written_stacks
  int by_thickness;
};

Result aggregated(const std::vector<std::string>& stacks) {
  const StackField field = written_stacks(1, stacks);
  std::vector<StackView> views;
  for (int j = 0; j < field.rows; ++j) views.push_back(field.stack(0, j));
  Aggregation result;
  aggregate(views, field.highest_m(), result);
  std::string letters;
  for (const Layer& layer : result.layers) {
    EXPECT_EQ(layer.start_m, static_cast<float>(letters.size()));
    EXPECT_EQ(layer.end_m, std::round(layer.end_m));
    letters.append(static_cast<std::size_t>(layer.end_m - layer.start_m), ".rslc"[layer.material]);
  }
  return {letters, result.by_thickness};
}

std::string one_of(const std::vector<std::string>& stacks) { return aggregated(stacks).layers; }

TEST(Aggregate, OneStackIsItself) { EXPECT_EQ(one_of({"rs.l."}), "rs.l."); }

TEST(Aggregate, TakesWhatMostStacksHave) {
  EXPECT_EQ(one_of({"rrr.", "rr..", "rr..", "rr.."}), "rr..");
  EXPECT_EQ(one_of({"rrr.", "rrr.", "rrr.", "rr.."}), "rrr.");
}

TEST(Aggregate, TwoOfFourDominateIfTheOthersDiffer) {
  EXPECT_EQ(one_of({"rr.", "rr.", "rs.", "r.."}), "rr.");
  EXPECT_EQ(one_of({"r..", "r..", "rs.", "rr."}), "r..");
}

TEST(Aggregate, OneVoteFillsATiedSegment) {
  // r below, and the air above is not among r and s.
  EXPECT_EQ(one_of({"rr.", "rr.", "rs.", "ss."}), "rr.");
  EXPECT_EQ(one_of({".rs", ".rs", ".ss", ".sr"}), ".ss");
}

TEST(Aggregate, TwoEqualVotesFillATiedSegment) {
  EXPECT_EQ(one_of({"rrr.", "rrr.", "rsr.", "sss."}), "rrr.");
}

TEST(Aggregate, TwoVotesPartATiedSegmentInItsMiddle) {
  EXPECT_EQ(one_of({"rrrr.", "rrrr.", "rr...", "r...."}), "rrr..");
  EXPECT_EQ(one_of({"srrrr", "srrrr", "sssrr", "sssrr"}), "ssrrr");
}

TEST(Aggregate, FourMaterialsAreTiedAsWell) {
  EXPECT_EQ(one_of({"rrr.", "rss.", "rll.", "r..."}), "rr..");
}

TEST(Aggregate, LooksBeyondWhatIsNotAmongTheTied) {
  // r and s are tied at 2 to 3 m; lime below and air above say nothing, rock under the lime does.
  EXPECT_EQ(one_of({"rlr.", "rlr.", "rls.", "lls."}), "rlr.");
}

TEST(Aggregate, TheNearestVoteDecides) {
  // r votes one segment below, s two segments above.
  EXPECT_EQ(one_of({"rr.s", "rr.s", "rs.s", "rs.s"}), "rr.s");
}

TEST(Aggregate, ReadsCountsAndNoResults) {
  // Rock and air are tied at 1 to 2 m and at 2 to 3 m: the lower one takes the rock below it, the
  // upper one the air above it, not the rock that the lower one became.
  EXPECT_EQ(one_of({"rr..", "rr..", "r.r.", "r.r."}), "rr..");
}

TEST(Aggregate, WithoutAVoteTheLargestThicknessFills) {
  const Result sand = aggregated({"ssss", "rrr."});
  EXPECT_EQ(sand.layers, "ssss");
  EXPECT_EQ(sand.by_thickness, 2);  // 0 to 3 m and 3 to 4 m
  // Air 5, rock 3: air, though it is no solid.
  EXPECT_EQ(one_of({"r...", ".rr."}), "....");
  // Air 5, rock 4, sand 3; each segment looks among its own two.
  EXPECT_EQ(one_of({"rrr...", "sss..r"}), "rrr...");
}

TEST(Aggregate, OfEqualThicknessSolidGoesBeforeAirAndTheLowestIndexFirst) {
  EXPECT_EQ(one_of({"ss", ".."}), "ss");
  EXPECT_EQ(one_of({"..", "ss"}), "ss");
  EXPECT_EQ(one_of({"ss", "rr"}), "rr");
  EXPECT_EQ(one_of({"ss", "rr", "..", "ll"}), "rr");
}

TEST(Aggregate, CountsNoThicknessWhereThereIsAVote) {
  EXPECT_EQ(aggregated({"rrr.", "rss.", "rll.", "r..."}).by_thickness, 0);
}

// Rock votes from below and from above.
TEST(Aggregate, ASharedCaveOfTwoStacksVanishes) {
  EXPECT_EQ(one_of({"rr.r..", "rr.r..", "rrrr..", "rrrr.."}), "rrrr..");
}

// Between 1 and the next float no float lies: the middle rounds to the even one of them.
TEST(Aggregate, ASegmentOfOneFloatIsNotParted) {
  StackField field = test_support::empty_stacks(4, 1, 4);
  const float next_m = std::nextafter(1.0F, 2.0F);
  StackWriter writer(field);
  for (const float end_m : {1.0F, 1.0F, next_m, next_m}) {
    const Layer layer{0.0F, end_m, 1};
    writer.add({&layer, 1});
  }
  const std::vector<StackView> stacks = {field.stack(0, 0), field.stack(1, 0), field.stack(2, 0),
                                         field.stack(3, 0)};
  Aggregation result;
  aggregate(stacks, 4.0F, result);
  const std::vector<Layer> expected = {{0.0F, 1.0F, 1}, {1.0F, 4.0F, kAir}};
  EXPECT_EQ(result.layers, expected);
}

TEST(Aggregate, RefusesStacksThatDoNotFit) {
  const StackField field = written_stacks(1, {"r."});
  StackView raised = field.stack(0, 0);
  raised.low_m = 0.5F;
  Aggregation result;
  EXPECT_THROW(aggregate({}, 2.0F, result), std::invalid_argument);
  EXPECT_THROW(aggregate(std::vector<StackView>(5, field.stack(0, 0)), 2.0F, result),
               std::invalid_argument);
  EXPECT_THROW(aggregate(std::vector{field.stack(0, 0), raised}, 2.0F, result),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumb::terrain
