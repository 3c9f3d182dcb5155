// Ground so steep that a place off by a rounding is a height off by thousands of them.
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "small_audits.h"

namespace plumb::audit {
namespace {

// A needle 214.8 km high on 20 m, from 200 km away: the eye's and the ray's roundings, some 1e-11 m
// each, stand for 1e-7 m of height there.
TEST(SteepGround, FullDetailFromFarAwayIsExact) {
  terrain::Heightfield field = plane(16);
  field.dx_m = field.dy_m = 20.2;
  field.heights_m.floats()(12, 8) = 214800.0f;
  LookAt look;
  look.eye_m = {-100106.807185, -111908.87156, 175362.199};
  look.target_m = {79.307903, 211.0283, 170421.44};
  look.fov_y_deg = 3.219;
  look.width_px = 69;
  look.height_px = 160;
  const DrawnSurface surface = mesh::full::draw(mesh::full::prepare(field), Camera{}, {});
  const AuditResult result = audit(field, surface, make_camera(look));
  const ClaimResult& pixels = claim(result, "pixel-error");
  EXPECT_EQ(pixels.claim.bound, 0.0);
  EXPECT_GT(pixels.measured, 1e-10);  // rounding is there to be forgiven
  EXPECT_LT(pixels.slack, 1e-5);
  EXPECT_TRUE(pixels.holds) << pixels.measured << " px beside a slack of " << pixels.slack;
}

}  // namespace
}  // namespace plumb::audit
