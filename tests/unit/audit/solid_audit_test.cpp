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

TriangleMesh raised(TriangleMesh mesh, double by_m) {
  for (glm::dvec3& vertex : mesh.vertices_m) vertex.z += by_m;
  return mesh;
}

/// Without the triangle that covers (x, y) and lies highest there.
TriangleMesh without_top_triangle_at(TriangleMesh mesh, double x, double y) {
  std::size_t highest = mesh.triangles.size();
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 &a = mesh.vertices_m[c[k]], &b = mesh.vertices_m[c[(k + 1) % 3]];
      inside = inside && (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0.0;
    }
    if (!inside || !(mesh.vertices_m[c[0]].z > height)) continue;
    height = mesh.vertices_m[c[0]].z;
    highest = t;
  }
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(highest));
  return mesh;
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

// Nothing lies below the sheet: every pixel that the triangle showed is a hole. Half a square metre
// at 107.2 / 16 pixels a metre has an area of 22.4 pixels, give or take half of its rim of 23.
TEST(SolidAudit, CountsTheHolesOfAMissingTriangle) {
  const terrain::Heightfield field = level_ground();
  const DrawnSurface exact = full_detail(field);
  const AuditResult result =
      audit_solid(field, with_mesh(exact, without_top_triangle_at(*exact.mesh, 8.2, 8.3)));
  EXPECT_EQ(result.coverage.holes, 10'000 - pixels_drawn(result));
  EXPECT_NEAR(static_cast<double>(result.coverage.holes), 22.4, 11.5);
  EXPECT_EQ(result.coverage.overshoots + result.coverage.see_through, 0);
  EXPECT_EQ(result.topology.open_edges, 3);
  EXPECT_EQ(result.verdict(), Verdict::Broken);
  EXPECT_EQ(result.nearest.forward.max, 0.0);
  EXPECT_GT(result.nearest.reverse_metres.max, 0.1);
  EXPECT_LT(result.nearest.reverse_metres.max, 0.3);  // a triangle's inner radius is 0.293 m
}

// A roof from 6 to 8 m over a floor at 2: through a missing triangle of its top its underside is
// seen. Pixels within the band of a rim that is drawn are not counted.
TEST(SolidAudit, CountsWhatIsSeenThroughAMissingTriangle) {
  const terrain::Heightfield field = solid([](int, int) { return "rr....rr.."; });
  const DrawnSurface exact = full_detail(field);
  const AuditResult result =
      audit_solid(field, with_mesh(exact, without_top_triangle_at(*exact.mesh, 8.2, 8.3)));
  EXPECT_EQ(pixels_drawn(result), 10'000);
  EXPECT_GT(result.coverage.see_through, 5);
  EXPECT_LT(result.coverage.see_through, 45);
  EXPECT_EQ(result.coverage.holes + result.coverage.overshoots, 0);
  EXPECT_EQ(result.verdict(), Verdict::Broken);
}

// The truth ends at the outline, 8 m from the middle; at 18 m below the eye 8.4 m are seen.
TEST(SolidAudit, CountsWhatIsDrawnBeyondTheTerrain) {
  const terrain::Heightfield field = solid([](int, int) { return "rr......"; });
  TriangleMesh wide;
  wide.vertices_m = {{-8, -8, 2}, {24, -8, 2}, {24, 24, 2}, {-8, 24, 2}};
  wide.triangles = {{0, 1, 2}, {0, 2, 3}};
  const AuditResult result = audit_solid(field, with_mesh(full_detail(field), wide));
  EXPECT_GT(result.coverage.overshoots, 100);
  EXPECT_EQ(result.coverage.holes + result.coverage.see_through, 0);
  EXPECT_EQ(result.topology.open_edges, 4);
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

// Level at 4 m, from west to east over each of these stretches.
TriangleMesh strips(std::vector<glm::dvec2> stretches) {
  TriangleMesh mesh;
  for (const glm::dvec2& x : stretches) {
    const auto at = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.insert(mesh.vertices_m.end(),
                           {{x[0], 0, 4}, {x[1], 0, 4}, {x[1], 16, 4}, {x[0], 16, 4}});
    mesh.triangles.insert(mesh.triangles.end(), {{at, at + 1, at + 2}, {at, at + 2, at + 3}});
  }
  return mesh;
}

Coverage coverage_of_strips(const TriangleMesh& truth, const TriangleMesh& drawn) {
  const terrain::Heightfield field = level_ground();
  const DrawnSurface any = full_detail(field);
  const MeshTruth narrow(field, with_mesh(any, truth));
  return audit_surface(narrow, with_mesh(any, drawn), from_20_m()).coverage;
}

// A pixel is 0.149 m wide, and x = 8 lies between two columns of them. A slit or a wire of 0.04 m
// there meets no pixel's centre, one of 0.2 m those of two columns, one of 1.2 m those of eight.
TEST(SolidAudit, ForgivesWhatIsDrawnAroundDetailBetweenPixels) {
  const auto slit = [](double half) { return strips({{0, 8 - half}, {8 + half, 16}}); };
  const auto wire = [](double half) { return strips({{8 - half, 8 + half}}); };
  EXPECT_EQ(coverage_of_strips(slit(0.02), slit(0.1)).holes, 0);
  EXPECT_EQ(coverage_of_strips(slit(0.0), slit(0.1)).holes, 200);
  EXPECT_EQ(coverage_of_strips(slit(0.02), slit(0.6)).holes, 800);
  EXPECT_EQ(coverage_of_strips(wire(0.02), wire(0.1)).overshoots, 0);
  EXPECT_EQ(coverage_of_strips(wire(0.02), wire(0.6)).overshoots, 800);
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
