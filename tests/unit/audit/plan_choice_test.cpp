#include <gtest/gtest.h>

#include <limits>

#include "audit/plan/choice.h"

namespace plumb::audit::plan {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Candidate candidate(const std::string& name, std::vector<double> errors, std::vector<double> costs,
                    double triangles = 10.0) {
  Candidate result{name, {}};
  for (std::size_t k = 0; k < errors.size(); ++k)
    result.measurements.push_back({k, errors[k], costs[k], triangles, true});
  return result;
}

Search search_of(std::size_t views, std::vector<std::size_t> family, double error = 1.0) {
  Search search;
  search.error = error;
  search.views = views;
  search.family = std::move(family);
  return search;
}

TEST(PlanChoice, IsTheCheapestThatKeepsTheErrorInEveryView) {
  const std::vector<Candidate> candidates = {candidate("exact", {0.0, 0.0}, {9.0, 9.0}),
                                             candidate("cheap", {0.5, 1.1}, {1.0, 1.0}),
                                             candidate("fair", {0.9, 1.0}, {3.0, 5.0})};
  const Choice choice = choose(candidates, search_of(2, {0, 1, 2}));
  ASSERT_TRUE(choice.best);
  EXPECT_EQ(choice.best->candidate, 2u);
  EXPECT_EQ(choice.best->cost, 4.0);
  EXPECT_EQ(choice.best->error, 1.0);
  EXPECT_EQ(choice.best->worst_view, 1u);
  EXPECT_EQ(choice.runner_up->candidate, 0u);
  EXPECT_EQ(choice.dearest->candidate, 0u);
  EXPECT_FALSE(choice.nearest);
}

TEST(PlanChoice, TakesARunnerUpOfAnotherFamily) {
  const std::vector<Candidate> candidates = {candidate("a at 1", {0.5}, {1.0}),
                                             candidate("a at 0.5", {0.2}, {2.0}),
                                             candidate("b at 1", {0.9}, {3.0})};
  EXPECT_EQ(choose(candidates, search_of(1, {0, 0, 1})).runner_up->candidate, 2u);
}

TEST(PlanChoice, OfEqualCostsHasTheFewestTrianglesThenTheFirst) {
  EXPECT_EQ(choose({candidate("many", {0.5}, {1.0}, 9.0), candidate("few", {0.5}, {1.0}, 8.0)},
                   search_of(1, {0, 1}))
                .best->candidate,
            1u);
  EXPECT_EQ(choose({candidate("first", {0.5}, {1.0}), candidate("second", {0.5}, {1.0})},
                   search_of(1, {0, 1}))
                .best->candidate,
            0u);
}

TEST(PlanChoice, DoesNotLookAtViewsHeldOut) {
  Search search = search_of(3, {0, 1});
  search.held_out = {2};
  const std::vector<Candidate> candidates = {candidate("a", {0.5, 0.5, 7.0}, {1.0, 1.0, 90.0}),
                                             candidate("b", {0.5, 0.5, 0.1}, {2.0, 2.0, 0.0})};
  const Choice choice = choose(candidates, search);
  EXPECT_EQ(choice.best->candidate, 0u);
  EXPECT_EQ(choice.best->cost, 1.0);
  ASSERT_TRUE(choice.held_out);
  EXPECT_EQ(choice.held_out->error, 7.0);
}

TEST(PlanChoice, SaysHowNearTheBestCameWhereNothingKeepsTheError) {
  const Choice choice = choose({candidate("a", {3.0}, {1.0}), candidate("b", {2.0}, {5.0}),
                                candidate("c", {kInfinity}, {0.0})},
                               search_of(1, {0, 1, 2}));
  EXPECT_FALSE(choice.best);
  ASSERT_TRUE(choice.nearest);
  EXPECT_EQ(choice.nearest->candidate, 1u);
}

TEST(PlanChoice, TakesNobodyThatBrokeAClaimUnlessToldTo) {
  Candidate broken = candidate("broken", {0.1}, {1.0});
  broken.measurements[0].keeps_claims = false;
  const std::vector<Candidate> candidates = {broken, candidate("kept", {0.1}, {2.0})};
  Search search = search_of(1, {0, 1});
  EXPECT_EQ(choose(candidates, search).best->candidate, 1u);
  search.claims_must_hold = false;
  EXPECT_EQ(choose(candidates, search).best->candidate, 0u);
}

TEST(PlanChoice, PassesOverWhatWasNotMeasuredInEveryView) {
  const Choice choice =
      choose({candidate("half", {0.1}, {1.0}), candidate("whole", {0.1, 0.2}, {2.0, 2.0})},
             search_of(2, {0, 1}));
  EXPECT_EQ(choice.best->candidate, 1u);
  EXPECT_EQ(choice.candidates, 1u);
  EXPECT_EQ(choice.incomplete, 1u);
}

TEST(PlanChoice, IsOfSoundQuestions) {
  const std::vector<Candidate> one = {candidate("a", {0.1}, {1.0})};
  EXPECT_THROW(choose(one, search_of(1, {0}, 0.0)), std::invalid_argument);
  EXPECT_THROW(choose(one, search_of(1, {})), std::invalid_argument);
  EXPECT_THROW(choose(one, search_of(0, {0})), std::invalid_argument);
  Search all = search_of(1, {0});
  all.held_out = {0};
  EXPECT_THROW(choose(one, all), std::invalid_argument);
}

TEST(PlanChoice, HoldsOutOneViewOfFour) {
  EXPECT_EQ(views_held_out(8), (std::vector<std::size_t>{3, 7}));
  EXPECT_EQ(views_held_out(3), (std::vector<std::size_t>{2}));
  EXPECT_TRUE(views_held_out(2).empty());
}

}  // namespace
}  // namespace plumb::audit::plan
