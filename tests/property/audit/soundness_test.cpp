// Every conservative claim in random scenes; and that a method which does not keep it is caught.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "audit/soundness/soundness.h"
#include "core/check.h"
#include "core/parallel.h"

namespace plumb::audit::soundness {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::int64_t kDraws = 150;  // a sanitizer takes some ten times as long
#else
constexpr std::int64_t kDraws = 1000;
#endif

void expect_sound(const Summary& summary) {
  for (const CaseResult& failure : summary.failures)
    ADD_FAILURE() << "case " << failure.drawn.index << ": " << name_of(failure.outcome.ending)
                  << ": " << failure.outcome.reason << "\n"
                  << audit_command(failure.drawn.scene);
}

TEST(Soundness, EveryConservativeClaimHoldsInAThousandDraws) {
  const MethodTable& table = built_in_methods();
  const Summary summary = summary_of(table, run_cases(table, {1, 0, kDraws, ""}));
  EXPECT_EQ(summary.draws, kDraws);
  expect_sound(summary);
}

TEST(LongSoundness, EveryConservativeClaimHoldsInTenThousandDraws) {
  const MethodTable& table = built_in_methods();
  const Summary summary = summary_of(table, run_cases(table, {1, 0, 10 * kDraws, ""}));
  expect_sound(summary);
}

// A method that comes with plumb, and what is done to each surface that it draws.
using Harm = void (*)(DrawnSurface&, const Camera&);

MethodTable with_harmed(const std::string& name, Harm harm) {
  MethodTable table = built_in_methods();
  Method& row =
      *std::find_if(table.begin(), table.end(), [&](const Method& m) { return m.name == name; });
  row.prepare = [prepare = row.prepare, harm](const terrain::Heightfield& field,
                                              const MethodChoice& choice) {
    std::shared_ptr<const PreparedMethod> whole = prepare(field, choice);
    return adapt(std::move(whole), [harm](const std::shared_ptr<const PreparedMethod>& method,
                                          const Camera& camera, const Tolerance& tolerance) {
      DrawnSurface surface = method->draw(camera, tolerance);
      harm(surface, camera);
      return surface;
    });
  };
  return table;
}

// In one picture of sixteen, by the picture's width, one vertex of the mesh is twice as far off as
// is claimed of its patch, and a metre.
void move_a_vertex(DrawnSurface& surface, const Camera& camera) {
  if (camera.width_px % 16 != 0 || surface.mesh == nullptr || surface.mesh->vertices_m.empty())
    return;
  double bound_m = 0.0;
  for (const Claim& claim : surface.claims) {
    if (claim.unit == Unit::Metre) bound_m = std::max(bound_m, claim.bound);
  }
  auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
  mesh->vertices_m[mesh->vertices_m.size() / 2].z += 2.0 * bound_m + 1.0;
  surface.mesh = mesh;
}

void claim_half(DrawnSurface& surface, const Camera&) {
  for (Claim& claim : surface.claims) claim.bound *= 0.5;
}

// Of the thousand draws, those of one method that are not sound.
std::int64_t caught(const MethodTable& table, const std::string& method) {
  std::int64_t count = 0;
  for (std::int64_t k = 0; k < kDraws; ++k) {
    const Case drawn = draw_case(table, 1, k);
    if (drawn.scene.method == method) count += !is_sound(outcome_of(table, drawn.scene));
  }
  return count;
}

TEST(Soundness, CatchesAVertexThatIsSometimesOffWithinTheThousand) {
  EXPECT_GE(caught(with_harmed("restricted-quadtree", move_a_vertex), "restricted-quadtree"), 1);
}

TEST(Soundness, CatchesHalfOfTheErrorClaimedWithinTheThousand) {
  for (const char* method : {"restricted-quadtree", "tessellation", "chunked"})
    EXPECT_GE(caught(with_harmed(method, claim_half), method), 1) << method;
}

// Drawing alone, without auditing: what follows holds for the first thousand cases of the seed.
std::vector<CaseResult> drawn_alone(std::int64_t count) {
  std::vector<CaseResult> results(static_cast<std::size_t>(count));
  for (std::int64_t k = 0; k < count; ++k)
    results[static_cast<std::size_t>(k)].drawn = draw_case(built_in_methods(), 1, k);
  return results;
}

TEST(SoundnessDraws, ReachEveryTerrainMethodCameraAndProperty) {
  const Summary summary = summary_of(built_in_methods(), drawn_alone(1000));
  for (const Tally& tally : summary.tallies) {
    if (tally.heading == "measured" || tally.heading == "outcome") continue;
    for (const auto& [name, count] : tally.counts)
      EXPECT_GE(count, name == "away" || name == "caves (top)" ? 3 : 15)
          << tally.heading << ": " << name;
  }
  EXPECT_GE(count_of(summary, "reached", "voids"), 200);
  EXPECT_GE(count_of(summary, "reached", "cells that are not square"), 300);
  EXPECT_GE(count_of(summary, "reached", "an origin beyond 100 km"), 250);
  EXPECT_GE(count_of(summary, "reached", "an even number of samples along a side"), 400);
  EXPECT_GE(count_of(summary, "reached", "the eye below the ground"), 50);
  EXPECT_GE(count_of(summary, "reached", "a centre off the picture's middle"), 80);
}

TEST(SoundnessDraws, DependOnSeedAndIndexAlone) {
  const MethodTable& table = built_in_methods();
  const std::string line = audit_command(draw_case(table, 1, 7).scene);
  EXPECT_EQ(audit_command(draw_case(table, 1, 7).scene), line);
  EXPECT_NE(audit_command(draw_case(table, 1, 8).scene), line);
  EXPECT_NE(audit_command(draw_case(table, 2, 7).scene), line);
  const auto three = run_cases(table, {1, 6, 3, ""});
  EXPECT_EQ(audit_command(three[1].drawn.scene), line);
}

TEST(SoundnessDraws, AreAllDifferent) {
  std::set<std::string> lines;
  for (const CaseResult& result : drawn_alone(300)) lines.insert(audit_command(result.drawn.scene));
  EXPECT_EQ(lines.size(), 300u);
}

TEST(SoundnessDraws, AreOfOneMethodWhereItIsNamed) {
  for (std::int64_t k = 0; k < 20; ++k)
    EXPECT_EQ(draw_case(built_in_methods(), 1, k, "chunked").scene.method, "chunked");
  EXPECT_THROW(draw_case(built_in_methods(), 1, 0, "no-such-method"), InputError);
}

TEST(Soundness, HasTheSameOutcomesOnAnyNumberOfThreads) {
  const MethodTable& table = built_in_methods();
  const auto outcomes = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<Outcome> all;
    for (const CaseResult& result : run_cases(table, {3, 0, 60, ""})) all.push_back(result.outcome);
    return all;
  };
  const auto one = outcomes(1);
  EXPECT_EQ(outcomes(2), one);
  EXPECT_EQ(outcomes(5), one);
}

TEST(SoundnessCommand, QuotesWhatAShellWouldRead) {
  EXPECT_EQ(shell_word("a=1,2"), "a=1,2");
  EXPECT_EQ(shell_word("generate:plane?size=3&seed=1"), "'generate:plane?size=3&seed=1'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
}

TEST(SoundnessOutcome, IsSoundIfHeldOrForAStatedReason) {
  Outcome outcome;
  outcome.ending = Ending::Held;
  EXPECT_TRUE(is_sound(outcome));
  outcome.ending = Ending::Broken;
  EXPECT_FALSE(is_sound(outcome));
  outcome.ending = Ending::Failed;
  EXPECT_FALSE(is_sound(outcome));
  outcome.ending = Ending::None;
  EXPECT_FALSE(is_sound(outcome));
  outcome.reason = "nothing of the terrain is in view of this camera";
  EXPECT_TRUE(is_sound(outcome));
  outcome.ending = Ending::Refused;
  EXPECT_FALSE(is_sound(outcome));
  outcome.reason = "patches need 2 x 2 samples, generate:plane has 1 x 1";
  EXPECT_TRUE(is_sound(outcome));
}

}  // namespace
}  // namespace plumb::audit::soundness
