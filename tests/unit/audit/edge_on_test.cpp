// Ground that is seen edge on: no ray hits it, and it shows as soon as it is displaced.
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "small_audits.h"

namespace plumb::audit {
namespace {

constexpr double kSide_m = 80.0;  // of plane(9)

// On the level ground, near its northern border, and looks along it: what lies higher covers the
// picture's upper half.
Camera on_the_ground() {
  LookAt look;
  look.eye_m = {5.0, 75.0, 0.0};
  look.target_m = {60.0, 75.0, 0.0};
  look.width_px = 64;
  look.height_px = 48;
  return make_camera(look);
}

AuditResult audited(double raised_m, double band_m, double side_m = kSide_m) {
  AuditOptions options;
  options.band.metres = band_m;
  const terrain::Heightfield field = plane(9);
  return audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                       sheet(side_m, raised_m), on_the_ground(), options);
}

TEST(EdgeOn, GroundWithinTheToleranceIsNoOvershoot) {
  const AuditResult result = audited(0.5, 0.6);
  EXPECT_EQ(result.coverage.must_be_terrain, 0);
  EXPECT_GT(result.vertical.count, 100);  // much of it is drawn, and judged by the pixel error
  EXPECT_EQ(result.coverage.overshoots, 0);
}

TEST(EdgeOn, GroundBeyondTheToleranceIs) { EXPECT_GT(audited(0.5, 0.4).coverage.overshoots, 100); }

TEST(EdgeOn, GroundBeyondTheOutlineIs) {
  EXPECT_GT(audited(0.5, 0.6, 2.0 * kSide_m).coverage.overshoots, 10);
}

}  // namespace
}  // namespace plumb::audit
