// Eyes on the ground or so near to it that the surface drawn may lie above them, and far planes
// that it may lie beyond.
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "small_audits.h"

namespace plumb::audit {
namespace {

constexpr double kSide_m = 80.0;  // of plane(9)

// Over level ground, near its northern border, and looks along it: what lies higher than the eye
// covers the picture's upper half, what lies lower its lower half.
Camera above_the_ground(double eye_m) {
  LookAt look;
  look.eye_m = {5.0, 75.0, eye_m};
  look.target_m = {60.0, 75.0, eye_m};
  look.width_px = 64;
  look.height_px = 48;
  return make_camera(look);
}

AuditResult audited(double raised_m, double band_m, double side_m = kSide_m, double eye_m = 0.0) {
  AuditOptions options;
  options.band.metres = band_m;
  const terrain::Heightfield field = plane(9);
  return audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                       sheet(side_m, raised_m), above_the_ground(eye_m), options);
}

TEST(EdgeOn, GroundWithinTheToleranceIsNoOvershoot) {
  const AuditResult result = audited(0.5, 0.6);
  EXPECT_EQ(result.coverage.must_be_terrain, 0);
  EXPECT_GT(result.vertical.count, 100);  // much of it is drawn, and judged by the pixel error
  EXPECT_EQ(result.coverage.overshoots, 0);
}

// Where a band ends is known as well as a point drawn: half of all rays are rounded beyond it.
TEST(EdgeOn, GroundOnTheEdgeOfTheToleranceIsNoOvershoot) {
  constexpr float kGround_m = 2735.1F, kRaised_m = 2735.4F;
  terrain::Heightfield field = plane(9);
  field.heights_m = Grid<float>(9, 9, kGround_m);
  AuditOptions options;
  options.band.metres = double{kRaised_m} - double{kGround_m};
  const AuditResult result =
      audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                    sheet(kSide_m, kRaised_m), above_the_ground(kGround_m), options);
  EXPECT_GT(result.vertical.count, 100);
  EXPECT_EQ(result.coverage.overshoots, 0);
}

TEST(EdgeOn, GroundBeyondTheToleranceIs) { EXPECT_GT(audited(0.5, 0.4).coverage.overshoots, 100); }

TEST(EdgeOn, GroundBeyondTheOutlineIs) {
  EXPECT_GT(audited(0.5, 0.6, 2.0 * kSide_m).coverage.overshoots, 10);
}

// The eye stands below the surface drawn, which is where the tolerance allows it.
TEST(EdgeOn, GroundRaisedAboveTheEyeWithinTheToleranceLeavesNoHole) {
  const AuditResult result = audited(0.5, 0.6, kSide_m, 0.3);
  EXPECT_GT(result.coverage.must_be_terrain, 500);
  EXPECT_EQ(result.coverage.defect_count(), 0);
}

TEST(EdgeOn, GroundThatIsMissingBelowAnEyeHigherThanTheToleranceIsAHole) {
  EXPECT_GT(audited(0.5, 0.4, 1e-3, 0.7).coverage.holes, 500);
}

// Seen from 20 m above at 45 degrees, the upper part of the picture ends at the far plane; what is
// drawn lies 1.5 m lower, and more of it beyond that plane.
AuditResult below_a_far_plane(double band_m) {
  LookAt look;
  look.eye_m = {40.0, 20.0, 20.0};
  look.target_m = {40.0, 40.0, 0.0};
  look.fov_y_deg = 10.0;
  look.width_px = look.height_px = 48;
  look.far_m = 30.0;
  AuditOptions options;
  options.band.metres = band_m;
  const terrain::Heightfield field = plane(9);
  return audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                       sheet(kSide_m, -1.5), make_camera(look), options);
}

TEST(FarPlane, GroundLoweredBeyondItWithinTheToleranceLeavesNoHole) {
  const AuditResult result = below_a_far_plane(1.6);
  EXPECT_GT(result.coverage.must_be_terrain, 500);
  EXPECT_EQ(result.coverage.defect_count(), 0);
}

TEST(FarPlane, GroundLoweredBeyondItAndTheToleranceDoes) {
  EXPECT_GT(below_a_far_plane(0.1).coverage.holes, 100);
}

}  // namespace
}  // namespace plumb::audit
