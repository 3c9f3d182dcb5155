// Scenes whose errors can be computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/audit.h"
#include "audit/method.h"
#include "mesh/full/full_detail.h"
#include "support/test_terrain.h"

namespace plumb::audit {
namespace {

terrain::Heightfield plane(int size, double height_m, double slope = 0.0) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(size, size);
  field.dx_m = field.dy_m = 10.0;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i)
      field.heights_m.floats()(i, j) = static_cast<float>(height_m + slope * 10.0 * i);
  }
  return field;
}

// A square of two triangles over the whole terrain, `raised_m` above height zero.
DrawnSurface sheet(int size, double raised_m) {
  auto mesh = std::make_shared<TriangleMesh>();
  const double side = (size - 1) * 10.0;
  mesh->vertices_m = {
      {0, 0, raised_m}, {side, 0, raised_m}, {side, side, raised_m}, {0, side, raised_m}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  DrawnSurface surface;
  surface.mesh = mesh;
  return surface;
}

Camera from_above(double side_m, double height_m) {
  LookAt look;
  look.eye_m = {side_m / 2, side_m / 2, height_m};
  look.target_m = {side_m / 2, side_m / 2, 0.0};
  look.width_px = look.height_px = 100;
  look.fov_y_deg = 50.0;
  return make_camera(look);
}

// Straight down on a level plane that is drawn 2 m too high: a point r pixels from the middle at
// depth w is seen at r * w / (w - 2) of where it belongs.
TEST(ClosedForm, ASheetTooHighIsOffByItsParallax) {
  const terrain::Heightfield field = plane(65, 0.0);
  const Camera camera = from_above(640, 400);
  DrawnSurface surface = sheet(65, 2.0);
  surface.claims = {{Measure::SampleError, 2.0, Unit::Metre}};
  const AuditResult result =
      audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating), surface, camera);
  EXPECT_DOUBLE_EQ(result.samples.worst_m.error, 2.0);
  EXPECT_EQ(result.samples.metres.p50, 2.0);
  EXPECT_TRUE(result.holds());
  // Drawn points have depth 398; the true ones below them 400. A pixel's centre is (x, y) off the
  // middle.
  for (const auto& [x, y] :
       {std::pair(0, 0), std::pair(10, 80), std::pair(50, 50), std::pair(99, 99)}) {
    const double radius = std::hypot(x + 0.5 - 50.0, y + 0.5 - 50.0);
    // The point drawn lies within 1/512 px of the centre along each axis.
    EXPECT_NEAR(result.pixels.vertical_px[result.drawn.index(x, y)], radius * (1.0 - 398.0 / 400.0),
                0.00277 * 2.0 / 400.0 + 1e-6 * radius);
    EXPECT_NEAR(result.depth.p50, 2.0 / 400.0, 1e-7);
  }
  EXPECT_EQ(result.coverage.defect_count(), 0);
}

TEST(ClosedForm, ATightClaimHoldsAndOneJustBelowItIsBroken) {
  const terrain::Heightfield field = plane(33, 0.0);
  const Camera camera = from_above(320, 200);
  const HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  DrawnSurface surface = sheet(33, 1.0);
  surface.claims = {{Measure::SampleError, 1.0, Unit::Metre}};
  const AuditResult tight = audit_surface(truth, surface, camera);
  EXPECT_TRUE(tight.holds());
  EXPECT_DOUBLE_EQ(*tight.claims.front().tightness(), 1.0);
  surface.claims = {{Measure::SampleError, 1.0 - 1e-6, Unit::Metre}};
  const AuditResult broken = audit_surface(truth, surface, camera);
  EXPECT_FALSE(broken.holds());
  EXPECT_EQ(broken.claims.front().violations, 33 * 33);
  EXPECT_EQ(broken.claims.front().triangles_over, 2);
}

// The same samples, cut along the other diagonals: between samples the surfaces differ by half a
// cell's twist.
TEST(ClosedForm, OtherDiagonalsDifferByHalfTheTwistAtTheMiddleOfACell) {
  terrain::Heightfield field = plane(9, 0.0);
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 9; ++i)
      field.heights_m.floats()(i, j) = static_cast<float>(0.5 * i * j);  // twist 0.5 in every cell
  }
  const DrawnSurface surface =
      mesh::full::draw(mesh::full::prepare(field, {terrain::Diagonal::Fixed}), Camera{}, {});
  const AuditResult result = audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                                           surface, from_above(80, 100));
  EXPECT_EQ(result.samples.worst_m.error, 0.0);
  EXPECT_NEAR(result.edges.max_m, 0.25, 1e-12);
  const auto surface_claim =
      std::find_if(result.claims.begin(), result.claims.end(),
                   [](const ClaimResult& c) { return c.label == "surface-error"; });
  EXPECT_FALSE(surface_claim->holds);
}

// Long edges cross many lines: a single triangle pair over a ridge of 5 m at column 4.
TEST(ClosedForm, ALongEdgeIsComparedWhereItCrossesARidge) {
  terrain::Heightfield field = plane(9, 0.0);
  for (int j = 0; j < 9; ++j) field.heights_m.floats()(4, j) = 5.0f;
  const AuditResult result = audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                                           sheet(9, 0.0), from_above(80, 100));
  EXPECT_DOUBLE_EQ(result.samples.worst_m.error, 5.0);
  EXPECT_DOUBLE_EQ(result.edges.max_m, 5.0);
}

// Infinite, not averaged away: the whole picture shows nothing.
TEST(ClosedForm, AnEmptyMeshIsAllHoles) {
  const terrain::Heightfield field = plane(33, 0.0);
  DrawnSurface surface;
  surface.mesh = std::make_shared<TriangleMesh>();
  const AuditResult result = audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                                           surface, from_above(320, 100));
  EXPECT_EQ(result.coverage.holes, 100 * 100);
  EXPECT_EQ(result.samples.uncovered, 33 * 33);
  EXPECT_EQ(result.reverse_vertical.infinite, 100 * 100);
  EXPECT_FALSE(result.holds());
}

// A sheet that reaches a pixel further than the terrain is within the band; one of five pixels is
// not.
TEST(ClosedForm, AnOvershootIsOneOnlyBeyondTheBand) {
  const terrain::Heightfield field = plane(9, 0.0);
  const Camera camera = from_above(80, 200);  // the terrain ends 35 px from the picture's middle
  const HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const double pixel_m = 200.0 / camera.gamma_h;
  for (const auto& [pixels, overshoots] : {std::pair(0.9, false), std::pair(5.0, true)}) {
    auto mesh = std::make_shared<TriangleMesh>();
    const double out = pixels * pixel_m;
    mesh->vertices_m = {{0, 0, 0}, {80 + out, 0, 0}, {80 + out, 80, 0}, {0, 80, 0}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
    DrawnSurface surface;
    surface.mesh = mesh;
    const AuditResult result = audit_surface(truth, surface, camera);
    EXPECT_EQ(result.coverage.overshoots > 0, overshoots) << pixels;
    EXPECT_EQ(result.holds(), !overshoots);
  }
}

TEST(Limits, AreReadAndRefused) {
  EXPECT_EQ(parse_limit("pixel-error=1px").bound, 1.0);
  EXPECT_EQ(parse_limit("sample-error=5m").unit, Unit::Metre);
  EXPECT_EQ(parse_limit("coverage=0").unit, Unit::Count);
  for (const char* text : {"pixel-error", "pixel-error=", "pixel-error=1", "unheard-of=1px",
                           "coverage=-1", "reverse-pixel-error=1m", ""}) {
    EXPECT_ANY_THROW(parse_limit(text)) << text;
  }
}

TEST(Limits, AreJudgedBesideTheClaims) {
  const terrain::Heightfield field = plane(33, 0.0);
  AuditOptions options;
  options.limits = {parse_limit("sample-error=0.5m"), parse_limit("topology=0")};
  const AuditResult result = audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating),
                                           sheet(33, 1.0), from_above(320, 200), options);
  EXPECT_FALSE(result.holds());
  const auto limit = std::find_if(result.claims.begin(), result.claims.end(),
                                  [](const ClaimResult& c) { return c.is_limit; });
  EXPECT_FALSE(limit->holds);
  EXPECT_EQ(limit->measured, 1.0);
}

TEST(Distribution, TakesNearestRanksAndLeavesNaNOut) {
  std::vector<float> values;
  for (int k = 1; k <= 1000; ++k) values.push_back(static_cast<float>(k));
  values.push_back(std::numeric_limits<float>::quiet_NaN());
  const Distribution d = distribution_of(values);
  EXPECT_EQ(d.count, 1000);
  EXPECT_EQ(d.p50, 500.0);
  EXPECT_EQ(d.p95, 950.0);
  EXPECT_EQ(d.p99, 990.0);
  EXPECT_EQ(d.p999, 999.0);
  EXPECT_EQ(d.max, 1000.0);
  values.push_back(std::numeric_limits<float>::infinity());
  EXPECT_EQ(distribution_of(values).infinite, 1);
  EXPECT_EQ(distribution_of(values).max_finite, 1000.0);
  EXPECT_EQ(distribution_of({}).count, 0);
}

// A rim that is drawn lower than it is, within the tolerance, may let the eye through a void behind
// it: that is no crack. Judged by a narrower band the same pixels are some.
TEST(Coverage, ExplainsWhatIsSeenThroughAVoidPastARimThatKeepsToItsTolerance) {
  const Method& method = find_method(built_in_methods(), "restricted-quadtree");
  const Tolerance tolerance{3.0, Unit::Pixel};
  std::int64_t by_a_narrow_band = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const terrain::Heightfield field =
        test_support::rough_terrain(257, 257, seed, 150.0, 0.04, 10.0, 10.0);
    const auto prepared = prepare_method(method, field, {}, tolerance);
    const Camera camera = make_camera({.eye_m = {-300, 900, 260},
                                       .target_m = {1400, 1300, 40},
                                       .fov_y_deg = 35.0,
                                       .width_px = 480,
                                       .height_px = 270});
    const DrawnSurface surface = prepared->draw(camera, tolerance);
    const HeightfieldTruth truth(field, method.truth);
    AuditOptions options;
    options.nearest = false;
    options.band.pixels = tolerance.value;
    EXPECT_TRUE(audit_surface(truth, surface, camera, options).holds()) << seed;
    options.band.pixels = 0.01;
    by_a_narrow_band += audit_surface(truth, surface, camera, options).coverage.see_through;
  }
  EXPECT_GT(by_a_narrow_band, 0);
}

}  // namespace
}  // namespace plumb::audit
