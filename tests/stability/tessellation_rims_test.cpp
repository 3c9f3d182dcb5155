// Where the conservative rules of tessellation are easily broken: rims of patches, of voids and of
// the terrain, and tolerances out of reach.
#include <gtest/gtest.h>

#include <limits>

#include "support/tessellation_views.h"
#include "support/test_terrain.h"

namespace plumb::audit {
namespace {

using namespace mesh::tessellation;
using terrain::Diagonal;
using test_support::tessellation_with;

Camera view(const glm::dvec3& eye_m, const glm::dvec3& target_m) {
  return make_camera(
      {.eye_m = eye_m, .target_m = target_m, .fov_y_deg = 60.0, .width_px = 160, .height_px = 120});
}

AuditResult look(const terrain::Heightfield& field, const Parameters& parameters,
                 const Camera& camera, const Tolerance& tolerance) {
  return test_support::audit_tessellation(HeightfieldTruth(field, Diagonal::Blocks8),
                                          prepare(field, parameters), camera, tolerance);
}

terrain::Heightfield plain_with_void(int void_i, int void_j) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(9, 4);
  field.dx_m = field.dy_m = 10.0;
  field.heights_m.floats()(void_i, void_j) = std::numeric_limits<float>::quiet_NaN();
  return field;
}

// At full detail a block of 16 cells has other diagonals than the truth's blocks of 8, so beside a
// void other halves of cells exist.
TEST(TessellationRims, LargeBlocksHaveTheOutlineOfTheTruthAroundVoids) {
  for (const int void_i : {5, 6}) {
    const AuditResult result = look(plain_with_void(void_i, 1), tessellation_with(0.01, 16, 16),
                                    view({40, 20, 100}, {40, 20, 0}), {1.0, Unit::Pixel});
    EXPECT_EQ(result.coverage.holes, 0);
    EXPECT_EQ(result.coverage.overshoots, 0);
  }
}

// Two samples of 20 m at the ends of a diagonal that the truth does not have: 20 m between the
// samples, in a block whose bound is that of samples alone since there is a void in it.
TEST(TessellationRims, LargeBlocksWithAVoidKeepTheirBoundBetweenTheSamples) {
  terrain::Heightfield field = plain_with_void(0, 3);
  field.heights_m.floats()(5, 1) = field.heights_m.floats()(6, 2) = 20.0f;
  const AuditResult result = look(field, tessellation_with(0.01, 16, 16),
                                  view({40, 20, 100}, {40, 20, 0}), {1.0, Unit::Metre});
  const ClaimResult& claim = *test_support::frame_claim(result, "surface-error");
  EXPECT_LE(claim.measured, claim.claim.bound + 0.01);
}

// The eye is below the rim before it. A skirt hangs by what both patches may stray, and is seen
// whole.
TEST(TessellationRims, SkirtsStayWithinTheToleranceFromBelow) {
  const AuditResult result =
      look(test_support::rough_terrain(33, 33, 1), tessellation_with(0.01, 8),
           view({160, -30, 20}, {160, 160, 30}), {2.0, Unit::Pixel});
  const ClaimResult& claim = *test_support::frame_claim(result, "pixel-error");
  EXPECT_LE(claim.measured, claim.claim.bound) << claim.violations << " pixels";
}

// What is out of reach moves silhouettes by more than was asked for.
TEST(TessellationRims, CoverageHoldsWhereTheToleranceIsOutOfReach) {
  const terrain::Heightfield field = test_support::rough_terrain(65, 65, 5, 20.0);
  const Camera camera = view({300, -200, 300}, {320, 320, 0});
  const DrawnSurface surface =
      draw(prepare(field, tessellation_with(500.0, 16)), camera, {1.0, Unit::Pixel});
  AuditOptions options;  // those of the command line
  options.band.pixels = 1.0;
  const AuditResult result =
      audit_surface(HeightfieldTruth(field, Diagonal::Blocks8), surface, camera, options);
  EXPECT_EQ(result.coverage.defect_count(), 0);
}

// Linear across patches of levels far apart: no wall is there to close what rounding opens at a
// T-junction.
TEST(TessellationRims, NoPixelIsLostAtATJunctionWithoutAWall) {
  const terrain::Heightfield rough = test_support::rough_terrain(257, 257, 8, 60.0);
  terrain::Heightfield field = rough;
  for (int j = 0; j < 257; ++j)
    for (int i = 0; i < 257; ++i)
      if (i >= 40 || j >= 40)
        field.heights_m.floats()(i, j) = static_cast<float>(30.0 + 0.0625 * i);
  const AuditResult result = look(field, tessellation_with(0.01, 16),
                                  view({60, 700, 150}, {390, 390, 30}), {1.0, Unit::Pixel});
  EXPECT_EQ(result.coverage.defect_count(), 0);
}

}  // namespace
}  // namespace plumb::audit
