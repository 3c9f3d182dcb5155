// Holes, overshoots and what is seen through, planted in surfaces that are no heightfields.
#include "audit/solid_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "solid_scenes.h"

namespace plumb::audit {
namespace {

// Nothing lies below the sheet: every pixel that the triangle showed is a hole. Half a square metre
// at 107.2 / 16 pixels a metre has an area of 22.4 pixels, give or take half of its rim of 23.
TEST(SolidCoverage, CountsTheHolesOfAMissingTriangle) {
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
TEST(SolidCoverage, CountsWhatIsSeenThroughAMissingTriangle) {
  const terrain::Heightfield field = solid([](int, int) { return "rr....rr.."; });
  const DrawnSurface exact = full_detail(field);
  const AuditResult result =
      audit_solid(field, with_mesh(exact, without_top_triangle_at(*exact.mesh, 8.2, 8.3)));
  EXPECT_EQ(pixels_drawn(result), 10'000);
  // The top lies 12 m below the eye, its underside 14.
  const std::int64_t torn = std::count_if(result.drawn.depth_m.begin(), result.drawn.depth_m.end(),
                                          [](double depth) { return depth > 13.0; });
  EXPECT_NEAR(static_cast<double>(torn), 0.5 * 107.2 * 107.2 / 144.0, 15.0);  // half its rim
  EXPECT_GT(result.coverage.see_through, torn / 4);
  EXPECT_LT(result.coverage.see_through, torn);
  EXPECT_EQ(result.coverage.holes + result.coverage.overshoots, 0);
  EXPECT_EQ(result.verdict(), Verdict::Broken);
}

// Half a metre too low, up to 2.1 pixels off: behind all truth, and yet nothing is torn.
TEST(SolidCoverage, CallsNothingTornThatIsMerelyDisplaced) {
  const terrain::Heightfield field = level_ground();
  const DrawnSurface exact = full_detail(field);
  const AuditResult result = audit_solid(field, with_mesh(exact, raised(*exact.mesh, -0.5)));
  EXPECT_GT(result.nearest.reverse.max, 2.0);
  EXPECT_EQ(result.coverage.defect_count(), 0);
}

// The truth ends at the outline, 8 m from the middle; at 18 m below the eye 8.4 m are seen.
TEST(SolidCoverage, CountsWhatIsDrawnBeyondTheTerrain) {
  const terrain::Heightfield field = solid([](int, int) { return "rr......"; });
  TriangleMesh wide;
  wide.vertices_m = {{-8, -8, 2}, {24, -8, 2}, {24, 24, 2}, {-8, 24, 2}};
  wide.triangles = {{0, 1, 2}, {0, 2, 3}};
  const AuditResult result = audit_solid(field, with_mesh(full_detail(field), wide));
  EXPECT_GT(result.coverage.overshoots, 100);
  EXPECT_EQ(result.coverage.holes + result.coverage.see_through, 0);
  EXPECT_EQ(result.topology.open_edges, 4);
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
TEST(SolidCoverage, ForgivesWhatIsDrawnAroundDetailBetweenPixels) {
  const auto slit = [](double half) { return strips({{0, 8 - half}, {8 + half, 16}}); };
  const auto wire = [](double half) { return strips({{8 - half, 8 + half}}); };
  EXPECT_EQ(coverage_of_strips(slit(0.02), slit(0.1)).holes, 0);
  EXPECT_EQ(coverage_of_strips(slit(0.0), slit(0.1)).holes, 200);
  EXPECT_EQ(coverage_of_strips(slit(0.02), slit(0.6)).holes, 800);
  EXPECT_EQ(coverage_of_strips(wire(0.02), wire(0.1)).overshoots, 0);
  EXPECT_EQ(coverage_of_strips(wire(0.02), wire(0.6)).overshoots, 800);
}

}  // namespace
}  // namespace plumb::audit
