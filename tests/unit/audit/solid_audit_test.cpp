// The audit of surfaces that are no heightfields, on scenes whose errors are known.
#include "audit/solid_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "audit/audit_json.h"
#include "core/check.h"
#include "core/parallel.h"
#include "solid_scenes.h"
#include "terrain/terrain_source.h"

namespace plumb::audit {
namespace {

const ClaimResult& claim_of(const AuditResult& result, const std::string& label) {
  return *std::find_if(result.claims.begin(), result.claims.end(),
                       [&](const ClaimResult& c) { return c.label == label; });
}

// Ground at 4 m and a block of 5 x 5 m that rises to 12: 16 m and 8 m below the eye. A depth is a
// quotient of sums of coordinates up to 20, rounded some eight times.
TEST(MeshTruth, IsHitWhereABlockOfRockStands) {
  const terrain::Heightfield field = solid(
      [](int i, int j) { return in_the_middle(i, j) ? "rrrrrrrrrrrr..." : "rrrr..........."; });
  const HitImage hits = truth_of(field).caster().cast_frame(from_20_m());
  constexpr double kRounding = 8.0 * 20.0 * std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(hits.depth_m[hits.index(50, 50)], 8.0, kRounding);
  EXPECT_NEAR(hits.depth_m[hits.index(3, 3)], 16.0, kRounding);
}

TEST(SolidAudit, FindsNothingWrongWithTheTruthItself) {
  const terrain::Heightfield field = terrain::load_terrain("generate:caves?size=33&spacing=8");
  const MeshTruth truth = truth_of(field);
  LookAt look;
  look.eye_m = {-100.0, -80.0, 400.0};
  look.target_m = {128.0, 128.0, 60.0};
  look.width_px = 160;
  look.height_px = 90;
  AuditOptions options;
  for (const char* limit : {"nearest-error=0px", "nearest-error=0m", "topology=0", "coverage=0"})
    options.limits.push_back(parse_limit(limit));
  const AuditResult result = audit_surface(truth, full_detail(field), make_camera(look), options);
  EXPECT_GT(result.nearest.forward.count, 1000);
  for (const Distribution* none :
       {&result.nearest.forward, &result.nearest.reverse, &result.nearest.forward_metres,
        &result.nearest.reverse_metres, &result.nearest.forward_vertices.distribution,
        &result.nearest.reverse_vertices.distribution}) {
    EXPECT_EQ(none->max, 0.0);
    EXPECT_GT(none->count, 0);
  }
  EXPECT_EQ(result.coverage.defect_count(), 0);
  EXPECT_TRUE(result.topology.is_sound());
  EXPECT_GT(result.topology.boundary_edges, 0);
  EXPECT_TRUE(result.holds());
  EXPECT_FALSE(result.of_heights);
}

// Half a metre up from 16 m below the eye. A point that is drawn 15.5 m below shows o pixels off
// the middle, and its nearest, straight below, 15.5 / 16 of that: o / 32 apart. The other way round
// it is o * 0.5 / 15.5. The farthest pixel is o = 49.5 * sqrt(2) off; of what is drawn, give or
// take the snapping. Maps are float32.
TEST(SolidAudit, MeasuresHowFarACopyIsShifted) {
  const terrain::Heightfield field = level_ground();
  const DrawnSurface exact = full_detail(field);
  const AuditResult result =
      audit_solid(field, with_mesh(exact, raised(*exact.mesh, 0.5)), {"nearest-error=0.5m"});
  const double off = 49.5 * std::sqrt(2.0);
  EXPECT_NEAR(result.nearest.forward.max, off / 32, kSnapShiftPx / 32);
  EXPECT_NEAR(result.nearest.reverse.max, off / 31, 1e-6);
  for (const Distribution* metres : {&result.nearest.forward_metres, &result.nearest.reverse_metres,
                                     &result.nearest.forward_vertices.distribution,
                                     &result.nearest.reverse_vertices.distribution}) {
    EXPECT_EQ(metres->max, 0.5);
    EXPECT_EQ(metres->p50, 0.5);
  }
  EXPECT_EQ(result.nearest.forward.count, 10'000);
  EXPECT_NEAR(result.depth.max, 0.5 / 16, 1e-6);
  EXPECT_EQ(result.normal_deg.max, 0.0);
  EXPECT_TRUE(result.holds());
}

TEST(SolidAudit, JudgesClaimsBothWays) {
  const terrain::Heightfield field = level_ground();
  const DrawnSurface exact = full_detail(field);
  DrawnSurface shifted = with_mesh(exact, raised(*exact.mesh, 0.5));
  shifted.claims.push_back(
      {Measure::NearestError, 2.22, Unit::Pixel});  // 2.188 forward, 2.258 back
  const AuditResult result = audit_solid(field, shifted, {"nearest-error=0.4m"});
  EXPECT_EQ(result.verdict(), Verdict::Broken);
  const ClaimResult& claim = claim_of(result, "nearest-error");
  EXPECT_TRUE(claim.is_broken());
  EXPECT_EQ(claim.measured, result.nearest.reverse.max);
  EXPECT_EQ(claim.violations, 12);  // 2.22 * 31 = 68.8 px off: (49.5, 49.5) and (49.5, 48.5) are
  const ClaimResult& limit = result.claims.back();
  EXPECT_EQ(limit.claim.unit, Unit::Metre);
  const std::int64_t vertices = static_cast<std::int64_t>(exact.mesh->vertices_m.size());
  EXPECT_EQ(limit.violations, 2 * 10'000 + 2 * vertices);
}

TEST(SolidAudit, RefusesWhatOnlyHeightsHave) {
  const terrain::Heightfield field = level_ground();
  DrawnSurface surface = full_detail(field);
  for (const char* limit : {"pixel-error=1px", "sample-error=1m", "surface-error=1m",
                            "uncovered-samples=0", "reverse-pixel-error=1px"}) {
    EXPECT_THROW(audit_solid(field, surface, {limit}), InputError) << limit;
  }
  surface.claims.push_back({Measure::SampleError, 1.0, Unit::Metre});
  EXPECT_THROW(audit_solid(field, surface), InputError);
  AuditOptions options;
  options.limits = {parse_limit("nearest-error=1m")};
  EXPECT_THROW(audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                             full_detail(field), from_20_m(), options),
               InputError);
}

// A cave from 2 to 6 m below ground at 8: its floor's middle lies 6 m below what is drawn without
// it, and no pixel shows that.
TEST(SolidAudit, MissesACaveThatVanished) {
  const terrain::Heightfield field =
      solid([](int i, int j) { return in_the_middle(i, j) ? "rr....rr.." : "rrrrrrrr.."; });
  const DrawnSurface without = full_detail(solid([](int, int) { return "rrrrrrrr.."; }));
  const AuditResult result = audit_solid(field, without, {"nearest-error=5m"});
  EXPECT_EQ(result.nearest.forward_vertices.distribution.max, 0.0);
  EXPECT_EQ(result.nearest.reverse_vertices.distribution.max, 6.0);
  EXPECT_EQ(result.nearest.reverse.max, 0.0);
  const ClaimResult& limit = result.claims.back();
  ASSERT_TRUE(limit.worst.has_value());
  EXPECT_EQ(limit.worst->world_m.z, 2.0);
  EXPECT_EQ(result.verdict(), Verdict::Broken);
}

TEST(SolidAudit, MissesAPitThatVanished) {
  const terrain::Heightfield field =
      solid([](int i, int j) { return in_the_middle(i, j) ? "rr........" : "rrrrrrrr.."; });
  const DrawnSurface without = full_detail(solid([](int, int) { return "rrrrrrrr.."; }));
  const AuditResult result = audit_solid(field, without);
  EXPECT_EQ(result.nearest.reverse_metres.max, 6.0);
  EXPECT_GT(result.nearest.forward_metres.max, 1.0);  // from the lid to the pit's walls
  EXPECT_LT(result.nearest.forward_metres.max, 3.0);
}

TEST(SolidAudit, TellsOutsideFromInside) {
  const terrain::Heightfield field = level_ground();
  const DrawnSurface exact = full_detail(field);
  TriangleMesh turned = *exact.mesh;
  for (Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(audit_solid(field, with_mesh(exact, turned)).normal_deg.p50, 180.0);
}

nlohmann::json json_with(int threads) {
  const ThreadLimit limit(threads);
  const terrain::Heightfield field = terrain::load_terrain("generate:caves?size=65&spacing=8");
  MethodChoice choice;
  choice.variant = "published";
  LookAt look;
  look.eye_m = {-100.0, -80.0, 400.0};
  look.target_m = {256.0, 256.0, 60.0};
  look.width_px = 160;
  look.height_px = 90;
  const Camera camera = make_camera(look);
  const Tolerance tolerance{60.0, Unit::Pixel};
  const DrawnSurface surface =
      prepare_method(find_method(built_in_methods(), "stacks"), field, choice, tolerance)
          ->draw(camera, tolerance);
  AuditOptions options;
  options.band.pixels = 4.0;
  AuditSubject subject;
  subject.field = &field;
  subject.camera = camera;
  nlohmann::json json = nlohmann::json::parse(
      audit_json(audit_surface(truth_of(field), surface, camera, options), subject));
  json.erase("timing");
  return json;
}

TEST(SolidAudit, SaysTheSameOnOneThreadAndTwo) {
  const nlohmann::json one = json_with(1);
  EXPECT_EQ(one, json_with(2));
  EXPECT_GT(one.at("errors").at("pixel_nearest_reverse_m").at("max"), 0.0);
  EXPECT_TRUE(one.at("errors").at("sample_m").is_null());
  EXPECT_TRUE(one.at("errors").at("pixel_vertical_px").is_null());
}

}  // namespace
}  // namespace plumb::audit
