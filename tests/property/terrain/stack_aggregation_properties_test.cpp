// What holds of any four stacks that become one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/drawn_stacks.h"
#include "support/slow_aggregation.h"
#include "terrain/stacks/stack_aggregation.h"

namespace plumb::terrain {
namespace {

using test_support::Draws;
using test_support::SlowAggregation;
using test_support::Stacks;

constexpr int kHigh_m = 16;

Aggregation aggregated(const Stacks& stacks) {
  StackField field = test_support::empty_stacks(static_cast<int>(stacks.size()), 1, kHigh_m);
  StackWriter writer(field);
  for (const auto& layers : stacks) writer.add(layers);
  std::vector<StackView> views;
  for (int i = 0; i < field.columns; ++i) views.push_back(field.stack(i, 0));
  Aggregation result;
  aggregate(views, field.highest_m(), result);
  return result;
}

/// With neighbours of one material joined, as a field keeps them.
Stacks drawn_stacks(Draws& draws, int count, int materials, int most) {
  StackField field = test_support::empty_stacks(count, 1, kHigh_m);
  StackWriter writer(field);
  for (int k = 0; k < count; ++k)
    writer.add(test_support::drawn_layers(draws, kHigh_m, materials, most));
  Stacks stacks;
  for (int k = 0; k < count; ++k) stacks.push_back(layers_of(field, k, 0));
  return stacks;
}

TEST(AnyStacks, BecomeWhatTheSlowRuleSays) {
  Draws draws(11);
  for (int round = 0; round < 30000; ++round) {
    const int materials = draws.whole(1, 5);
    const Stacks stacks = drawn_stacks(draws, draws.whole(1, 4), materials, 7);
    const SlowAggregation slow(stacks);
    const Aggregation fast = aggregated(stacks);
    ASSERT_EQ(fast.layers, slow.layers()) << round;
    ASSERT_EQ(fast.by_thickness, slow.by_thickness()) << round;
    ASSERT_EQ(static_cast<int>(fast.segments.size()), slow.segments()) << round;
  }
}

TEST(AnyStacks, BecomeTheSameInAnyOrder) {
  Draws draws(12);
  for (int round = 0; round < 2000; ++round) {
    const Stacks stacks = drawn_stacks(draws, 4, 5, 7);
    const std::vector<Layer> expected = aggregated(stacks).layers;
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    while (std::next_permutation(order.begin(), order.end())) {
      ASSERT_EQ(aggregated({stacks[order[0]], stacks[order[1]], stacks[order[2]], stacks[order[3]]})
                    .layers,
                expected);
    }
  }
}

std::vector<Layer> upside_down(std::vector<Layer> layers) {
  std::reverse(layers.begin(), layers.end());
  for (Layer& layer : layers)
    layer = {kHigh_m - layer.end_m, kHigh_m - layer.start_m, layer.material};
  return layers;
}

// Ends are quarters of a metre: sums of thicknesses and middles are exact either way.
TEST(AnyStacks, TurnedUpsideDownTurnTheResult) {
  Draws draws(13);
  for (int round = 0; round < 20000; ++round) {
    const Stacks stacks = drawn_stacks(draws, draws.whole(1, 4), draws.whole(2, 5), 7);
    Stacks turned = stacks;
    for (auto& layers : turned) layers = upside_down(layers);
    ASSERT_EQ(aggregated(turned).layers, upside_down(aggregated(stacks).layers)) << round;
  }
}

TEST(AnyStacks, OfOneSurfaceEachGiveTheMeanOfTheTwoMiddleHeights) {
  Draws draws(14);
  for (int round = 0; round < 2000; ++round) {
    std::array<float, 4> heights_m;
    Stacks stacks;
    for (float& height_m : heights_m) {
      height_m = static_cast<float>(draws.whole(1, 4 * kHigh_m - 1)) / 4.0F;
      stacks.push_back({{0.0F, height_m, 1}});
    }
    std::sort(heights_m.begin(), heights_m.end());
    const float mean_m = (heights_m[1] + heights_m[2]) / 2.0F;
    const std::vector<Layer> expected = {{0.0F, mean_m, 1}, {mean_m, float{kHigh_m}, kAir}};
    ASSERT_EQ(aggregated(stacks).layers, expected);
  }
}

// With two materials each is among any tied ones: whatever dominates anywhere has a vote.
TEST(AnyStacks, OfTwoMaterialsAskForThicknessOnlyWhereNothingDominates) {
  Draws draws(15);
  int asked = 0;
  for (int round = 0; round < 50000; ++round) {
    const Stacks stacks = drawn_stacks(draws, draws.whole(2, 4), 2, 5);
    const SlowAggregation slow(stacks);
    const Aggregation fast = aggregated(stacks);
    ASSERT_EQ(fast.by_thickness, slow.any_dominated() ? 0 : slow.segments());
    asked += fast.by_thickness > 0 ? 1 : 0;
  }
  EXPECT_GT(asked, 0);
}

// Few segments are left to their thickness: at most 0.2 % where stacks of a few layers are drawn at
// random (measured 0.016, 0.015 and 0.12 %), ever fewer the more layers there are.
TEST(AnyStacks, SeldomAskForThickness) {
  const auto share_of = [](int materials, int most) {
    Draws draws(16);
    std::size_t segments = 0;
    int asked = 0;
    for (int round = 0; round < 50000; ++round) {
      const Aggregation found = aggregated(drawn_stacks(draws, 4, materials, most));
      segments += found.segments.size();
      asked += found.by_thickness;
    }
    return asked / static_cast<double>(segments);
  };
  for (const int materials : {3, 4, 5}) {
    const double share = share_of(materials, 6);
    EXPECT_LT(share, 0.002) << materials;
    EXPECT_GT(share, 0.0) << materials;
    EXPECT_LT(share_of(materials, 12), share) << materials;
  }
}

}  // namespace
}  // namespace plumb::terrain
