// Surfaces without a mesh: what is measured of them, what is not, and what is set aside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/audit.h"
#include "audit/set_aside.h"
#include "audit/surface_picture.h"
#include "core/check.h"
#include "mesh/full/full_detail.h"
#include "support/test_terrain.h"

namespace plumb::audit {
namespace {

using Alter = std::function<void(HitImage&)>;

// The full-detail surface as a painter's picture, with something done to it.
class PaintedSurface : public testing::Test {
 protected:
  PaintedSurface() : field_(test_support::rough_terrain(129, 129, 3, 60.0)) {
    field_.origin_m = {512345.0, 4512345.0};
    look_.eye_m = field_.world_origin_m() + glm::dvec3(640, -200, 260);
    look_.target_m = field_.world_origin_m() + glm::dvec3(640, 700, 20);
    look_.width_px = 160;
    look_.height_px = 90;
  }

  DrawnSurface painted(const Alter& alter = {}) const {
    const DrawnSurface full = mesh::full::draw(mesh::full::prepare(field_), Camera{}, {});
    DrawnSurface surface;
    surface.patches = {{0, 1, 0, "west"}, {1, 1, 0, "east"}};
    surface.claims = {{Measure::PixelError, 0.5, Unit::Pixel}};
    surface.painter = [full, alter](const Camera& camera) {
      SurfacePicture picture = picture_of(full, camera);
      for (std::size_t k = 0; k < picture.image.size(); ++k) {
        if (picture.image.hit(k))
          picture.image.primitive[k] = static_cast<int>(k) % picture.image.width_px < 80 ? 0 : 1;
      }
      if (alter) alter(picture.image);
      return picture;
    };
    return surface;
  }

  AuditResult audit(const DrawnSurface& surface, const AuditOptions& options = {}) const {
    return audit_surface(HeightfieldTruth(field_, terrain::Diagonal::Alternating), surface,
                         make_camera(look_), options);
  }

  // Ground at height zero, with a gap of ten rows 300 m from the eye or without; the middle pixel,
  // (80, 45), sees `target_m`.
  void look_at_flat_ground(bool gap, const glm::dvec3& target_m) {
    field_ = terrain::Heightfield();
    field_.heights_m = Grid<float>(65, 65, 0.0f);
    field_.dx_m = field_.dy_m = 10.0;
    for (int i = 0; i < 65; ++i) {
      for (int j = 30; gap && j < 40; ++j)
        field_.heights_m.floats()(i, j) = std::numeric_limits<float>::quiet_NaN();
    }
    look_.eye_m = {320.0, 0.0, 100.0};
    look_.target_m = target_m;
    look_.width_px = 161;
    look_.height_px = 91;
  }

  terrain::Heightfield field_;
  LookAt look_;
};

const ClaimResult& claim(const AuditResult& result, const std::string& label) {
  return *std::find_if(result.claims.begin(), result.claims.end(),
                       [&](const ClaimResult& c) { return c.label == label; });
}

TEST_F(PaintedSurface, ThatIsTheTruthHoldsAndHasNoMeasureOfAMesh) {
  const AuditResult result = audit(painted());
  EXPECT_TRUE(result.holds());
  EXPECT_FALSE(result.of_mesh);
  EXPECT_EQ(result.pixels_set_aside, 0);
  EXPECT_GT(result.vertical.count, 3000);
  EXPECT_LT(result.vertical.max, 0.01);
  EXPECT_GT(result.depth.count, 3000);
  EXPECT_EQ(result.samples.metres.count, 0);
  EXPECT_EQ(result.normal_deg.count, 0);
  EXPECT_EQ(result.topology.triangles, 0);
  EXPECT_GT(result.cost.fragments, 3000);
}

TEST_F(PaintedSurface, ThatLacksAPixelHasAHoleInItsPatch) {
  const AuditResult result = audit(painted([](HitImage& image) {
    const std::size_t pixel = image.index(120, 70);
    image.depth_m[pixel] = kNoHit;
    image.from_eye_m[pixel] = glm::dvec3(0.0);
    image.primitive[pixel] = kNoPrimitive;
  }));
  EXPECT_FALSE(result.holds());
  EXPECT_EQ(result.coverage.holes, 1);
  ASSERT_FALSE(result.offenders.empty());
  EXPECT_EQ(result.offenders[0].what, "hole");
  EXPECT_EQ(result.offenders[0].x, 120);
  EXPECT_EQ(result.offenders[0].patch_name, "east");
}

// A point that is drawn farther along its ray, below the ground, was seen through it.
TEST_F(PaintedSurface, ThatIsDrawnTooDeepBreaksItsClaimThere) {
  const AuditResult result = audit(painted([](HitImage& image) {
    const std::size_t pixel = image.index(30, 70);
    image.depth_m[pixel] *= 1.05;
    image.from_eye_m[pixel] *= 1.05;
  }));
  const ClaimResult& broken = claim(result, "pixel-error");
  EXPECT_FALSE(broken.holds);
  EXPECT_EQ(broken.violations, 1);
  ASSERT_TRUE(broken.worst.has_value());
  EXPECT_EQ(broken.worst->x, 30);
  EXPECT_EQ(broken.worst->y, 70);
  EXPECT_EQ(broken.worst->patch_name, "west");
  EXPECT_EQ(result.pixels_set_aside, 0);
}

// From below the ground the truth shows its underside, and a solid shows what is next to the eye.
TEST_F(PaintedSurface, IsNotJudgedWhereItsRaysBeginBelowTheGround) {
  look_.eye_m = field_.world_origin_m() + glm::dvec3(640, 640, -300);
  look_.target_m = field_.world_origin_m() + glm::dvec3(640, 700, 20);
  const AuditResult solid = audit(painted([&](HitImage& image) {
    for (std::size_t k = 0; k < image.size(); ++k) {
      if (!image.hit(k)) continue;
      image.from_eye_m[k] /= image.depth_m[k];
      image.depth_m[k] = 1.0;
    }
  }));
  EXPECT_GT(solid.pixels_set_aside, 3000);
  EXPECT_EQ(solid.vertical.count, 0);
  EXPECT_EQ(solid.coverage.defect_count(), 0);
  EXPECT_EQ(solid.verdict(), Verdict::None);
  EXPECT_EQ(solid.no_verdict, "all that is in view of this camera is set aside");
}

// A ridge, and behind it flat ground, with a gap in it or without. A ray that is let pass below the
// ridge's top comes below the ground through the gap, or through the ground itself.
TEST_F(PaintedSurface, IsNotJudgedBehindAVoidThatALoweredRidgeLetsItsRayReach) {
  for (const bool gap : {true, false}) {
    look_at_flat_ground(gap, {320.0, 200.0, 49.5});  // just below the ridge's top
    for (int i = 0; i < 65; ++i) field_.heights_m.floats()(i, 20) = 50.0f;
    const AuditResult result = audit(painted([&](HitImage& image) {
      const std::size_t pixel = image.index(80, 45);
      ASSERT_TRUE(image.hit(pixel));
      const double farther = 450.0 / image.from_eye_m[pixel].y;
      ASSERT_LT(100.0 + farther * image.from_eye_m[pixel].z, -5.0);
      image.depth_m[pixel] *= farther;
      image.from_eye_m[pixel] *= farther;
    }));
    EXPECT_EQ(result.pixels_set_aside, gap ? 1 : 0);
    EXPECT_EQ(claim(result, "pixel-error").holds, gap) << gap;
  }
}

// Flat ground behind a gap: a ray that meets it 5 cm behind the rim may slip below a surface within
// the band, one that meets it 50 m behind may not.
TEST_F(PaintedSurface, IsNotJudgedWhereItsRayMaySlipBelowAVoidsRim) {
  for (const bool at_rim : {true, false}) {
    look_at_flat_ground(true, {320.0, at_rim ? 400.05 : 450.0, 0.0});
    const AuditResult result = audit(painted([&](HitImage& image) {
      const std::size_t pixel = image.index(80, 45);
      ASSERT_TRUE(image.hit(pixel));
      image.depth_m[pixel] *= 1.3;
      image.from_eye_m[pixel] *= 1.3;
    }));
    EXPECT_EQ(result.pixels_set_aside, at_rim ? 1 : 0);
    EXPECT_EQ(claim(result, "pixel-error").holds, at_rim);
  }
}

TEST_F(PaintedSurface, RefusesLimitsThatOnlyAMeshHas) {
  AuditOptions options;
  for (const char* limit : {"sample-error=1m", "surface-error=1px", "topology=0",
                            "reverse-pixel-error=1px", "uncovered-samples=0"}) {
    options.limits = {parse_limit(limit)};
    EXPECT_THROW(audit(painted(), options), InputError) << limit;
  }
  options.limits = {parse_limit("nearest-error=1px"), parse_limit("pixel-error=1px")};
  EXPECT_TRUE(audit(painted(), options).holds());
  EXPECT_THROW(picture_of({}, make_camera(look_)), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::audit
