// What an audit says where something is broken: how often, and where.
#include <gtest/gtest.h>

#include <cmath>

#include "audit/over_bound.h"
#include "audit/verdict_text.h"
#include "small_audits.h"

namespace plumb::audit {
namespace {

// Diagonals that alternate, and diagonals that all run the same way: half of 64 cells differ, by
// half their twist of 0.5 m in the middle. The eye sees all of them.
TEST(Violations, OfTheSurfaceErrorAreThePlacesBetweenTheSamplesThatAreOver) {
  const terrain::Heightfield field = twisted(9, 0.5);
  const DrawnSurface surface = full_detail(field, terrain::Diagonal::Fixed);
  const Camera camera = vertical_view(80, 120);
  for (const char* limit : {"surface-error=0.1m", "surface-error=0.001px"}) {
    const AuditResult result = audit(field, surface, camera, {limit});
    const ClaimResult& broken = claim(result, "surface-error");
    EXPECT_TRUE(broken.is_broken());
    EXPECT_EQ(broken.violations, 32) << limit;
    ASSERT_EQ(broken.places.size(), 20u);
    EXPECT_EQ(broken.places.front().value, broken.measured);
    for (const Offender& place : broken.places) {
      EXPECT_NEAR(std::remainder(place.world_m.x - 5.0, 10.0), 0.0, 1e-9) << limit;
      EXPECT_NEAR(std::remainder(place.world_m.y - 5.0, 10.0), 0.0, 1e-9) << limit;
      EXPECT_LT(place.triangle, surface.mesh->triangles.size());
      EXPECT_GE(place.x, 0);
    }
    EXPECT_EQ(result.offenders.front().what, "surface-error");
    EXPECT_EQ(breaking(result, "surface-error"), 20);
  }
  EXPECT_EQ(
      claim(audit(field, surface, camera, {"surface-error=0.25m"}), "surface-error").violations, 0);
}

// A sample raised by 3 m is over the bound of 1 m, and so are the middles of the four diagonals
// that end there, raised by 1.5 m.
TEST(Violations, OfTheSurfaceErrorHaveTheSamplesAmongThem) {
  const terrain::Heightfield field = plane(9);
  DrawnSurface surface = full_detail(field);
  auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
  const auto vertex =
      std::find(mesh->vertices_m.begin(), mesh->vertices_m.end(), glm::dvec3(40, 40, 0));
  ASSERT_NE(vertex, mesh->vertices_m.end());
  vertex->z = 3.0;
  surface.mesh = mesh;
  const AuditResult result =
      audit(field, surface, vertical_view(80, 120), {"surface-error=1m", "sample-error=1m"});
  EXPECT_EQ(claim(result, "surface-error").violations, 5);
  EXPECT_EQ(claim(result, "surface-error").worst->sample_i, 4);
  ASSERT_EQ(claim(result, "surface-error").places.size(), 5u);
  EXPECT_EQ(claim(result, "surface-error").places[1].value, 1.5);
  EXPECT_EQ(claim(result, "sample-error").violations, 1);
  EXPECT_EQ(worst_lines(result).size(), 2u);  // one for each
}

// The sheet fills the picture of 100 x 100 and is 2 m too high everywhere.
TEST(Violations, OfThePixelErrorInMetresAreThePixelsThatAreOver) {
  const AuditResult result =
      audit(plane(65), sheet(640, 2.0), vertical_view(640, 400), {"pixel-error=1m"});
  const ClaimResult& broken = claim(result, "pixel-error");
  EXPECT_DOUBLE_EQ(broken.measured, 2.0);
  EXPECT_EQ(broken.violations, 100 * 100);
  ASSERT_TRUE(broken.worst.has_value());
  EXPECT_EQ(broken.places.size(), 20u);
}

// Two levels, 1 m and 5 m too high: a shift on screen grows with the distance from the middle, a
// shift in metres does not.
TEST(Violations, OfThePixelErrorInMetresHaveTheirWorstWhereMetresAreMost) {
  DrawnSurface surface = sheet(640, 1.0);
  auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
  const auto first = static_cast<std::uint32_t>(mesh->vertices_m.size());
  for (const glm::dvec2& at : {glm::dvec2(318, 318), {322, 318}, {322, 322}, {318, 322}})
    mesh->vertices_m.emplace_back(at.x, at.y, 5.0);
  mesh->triangles.push_back({first, first + 1, first + 2});
  mesh->triangles.push_back({first, first + 2, first + 3});
  surface.mesh = mesh;
  const AuditResult result = audit(plane(65), surface, vertical_view(640, 400), {"pixel-error=3m"});
  const ClaimResult& broken = claim(result, "pixel-error");
  EXPECT_DOUBLE_EQ(broken.measured, 5.0);
  EXPECT_NEAR(broken.worst->world_m.x, 320.0, 2.0);
  EXPECT_NEAR(broken.worst->world_m.y, 320.0, 2.0);
  EXPECT_LT(broken.violations, 20);
  EXPECT_GT(broken.violations, 0);
}

TEST(Violations, OfNearestPointsAreCountedBothWays) {
  const AuditResult result = audit(plane(65), sheet(640, 2.0), vertical_view(640, 400),
                                   {"nearest-error=0.1px", "reverse-pixel-error=0.1px"});
  const auto over = [](const std::vector<float>& errors, double bound) {
    return std::count_if(errors.begin(), errors.end(), [&](float e) { return e > bound; });
  };
  EXPECT_EQ(claim(result, "nearest-error").violations,
            over(result.nearest.forward_px, 0.1) + over(result.nearest.reverse_px, 0.1));
  EXPECT_EQ(claim(result, "reverse-pixel-error").violations,
            over(result.reverse_pixels.vertical_px, 0.1));
  EXPECT_GT(claim(result, "reverse-pixel-error").violations, 1000);
}

// A triangle less leaves three open edges, whichever it is.
TEST(Violations, OfTopologyAreItsDefectsBeyondTheBoundAndHavePlaces) {
  const terrain::Heightfield field = plane(33);
  DrawnSurface surface = full_detail(field);
  auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
  mesh->triangles.erase(mesh->triangles.begin() + 700);
  surface.mesh = mesh;
  const Camera away = vertical_view(320, 100, false);
  const AuditResult result = audit(field, surface, away, {"topology=0", "topology=1"});
  EXPECT_EQ(result.verdict(), Verdict::Broken);
  EXPECT_EQ(claim(result, "topology").violations, 3);
  EXPECT_EQ(result.claims.back().violations, 2);
  EXPECT_EQ(breaking(result, "topology"), 3);
  for (const Offender& place : claim(result, "topology").places) {
    EXPECT_EQ(place.what, "open edge");
    EXPECT_LT(place.triangle, mesh->triangles.size());
    EXPECT_EQ(place.x, -1);
    EXPECT_GT(glm::length(place.world_m), 0.0);
  }
  const std::vector<std::string> lines = worst_lines(result);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].rfind("worst: topology (open edge) out of view, world (", 0), 0u) << lines[0];
  EXPECT_TRUE(std::all_of(result.offenders.begin(), result.offenders.end(),
                          [](const Offender& o) { return o.value > 0.0; }));
}

// 17 of 33 samples along each side have the sheet over them.
TEST(Violations, OfUncoveredSamplesAreThoseBeyondTheBoundAndHavePlaces) {
  const AuditResult result =
      audit(plane(33), sheet(160, 0.0), vertical_view(320, 100), {"uncovered-samples=100"});
  const ClaimResult& broken = claim(result, "uncovered-samples");
  EXPECT_EQ(broken.measured, 33 * 33 - 17 * 17);
  EXPECT_EQ(broken.violations, 33 * 33 - 17 * 17 - 100);
  ASSERT_EQ(broken.places.size(), 20u);
  // The first is the first sample of the south row past the sheet.
  EXPECT_EQ(broken.places.front().what, "uncovered sample");
  EXPECT_EQ(broken.places.front().sample_i, 17);
  EXPECT_EQ(broken.places.front().sample_j, 0);
  EXPECT_EQ(broken.places.front().world_m, glm::dvec3(170, 0, 0));
}

TEST(Violations, OfAPatchAreItsSamples) {
  DrawnSurface surface = sheet(320, 1.0);
  surface.claims = {{Measure::SampleError, 0.5, Unit::Metre, Scope::Patch, 0}};
  // Out of view, where the frame has nothing to say.
  const AuditResult result = audit(plane(33), surface, vertical_view(320, 100, false));
  const ClaimResult& broken = claim(result, "sample-error");
  EXPECT_EQ(result.verdict(), Verdict::Broken);
  EXPECT_EQ(result.patch_claims_broken, 1);
  EXPECT_EQ(broken.violations, 33 * 33);
  ASSERT_TRUE(broken.worst.has_value());
  EXPECT_EQ(broken.worst->value, 1.0);
  EXPECT_EQ(worst_lines(result).size(), 1u);
}

TEST(Offenders, NameSamplesUnderTwoSheetsAndVoidsThatAreDrawnOver) {
  terrain::Heightfield field = plane(33);
  field.heights_m.floats()(4, 5) = kVoid;
  DrawnSurface surface = full_detail(plane(33));
  auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
  const auto first = static_cast<std::uint32_t>(mesh->vertices_m.size());
  mesh->vertices_m.insert(mesh->vertices_m.end(), {{195, 195, 2}, {215, 195, 2}, {195, 215, 2}});
  for (int sheets = 0; sheets < 2; ++sheets)
    mesh->triangles.push_back({first, first + 1, first + 2});
  surface.mesh = mesh;
  const AuditResult result = audit(field, surface, vertical_view(320, 500));
  const auto find = [&](const char* what) {
    return std::find_if(result.offenders.begin(), result.offenders.end(),
                        [&](const Offender& o) { return o.what == what; });
  };
  const auto over_void = find("void drawn over"), overlapped = find("overlapped sample");
  ASSERT_NE(over_void, result.offenders.end());
  EXPECT_EQ(over_void->world_m, glm::dvec3(40, 50, 0));
  ASSERT_NE(overlapped, result.offenders.end());
  EXPECT_EQ(overlapped->world_m, glm::dvec3(200, 200, 0));
  EXPECT_EQ(overlapped->breaks, "");
}

TEST(OverBound, CountsTheLargestEvenWhereRoundingHidesIt) {
  const std::vector<float> values{1.0f, 0.5f, 2.0f, std::numeric_limits<float>::quiet_NaN()};
  EXPECT_EQ(count_above(values, 0.75), 2);
  EXPECT_EQ(count_above(values, 2.0), 1);  // known to be over
  EXPECT_EQ(count_above_exactly(values, 2.0), 0);
  EXPECT_EQ(beyond(8, 5.0), 3);
  EXPECT_EQ(beyond(8, 5.5), 3);
  EXPECT_EQ(beyond(8, 8.0), 0);
  EXPECT_EQ(beyond(8, 1e300), 0);
}

}  // namespace
}  // namespace plumb::audit
