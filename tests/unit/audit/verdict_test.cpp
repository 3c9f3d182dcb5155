// What an audit says where nothing, or not everything, could be measured.
#include <gtest/gtest.h>

#include "audit/verdict_text.h"
#include "small_audits.h"

namespace plumb::audit {
namespace {

TEST(Verdict, IsNoneWhereTheCameraLooksAwayFromTheTerrain) {
  const terrain::Heightfield field = plane(33);
  DrawnSurface surface = full_detail(field);
  // What a patch says of itself does not make a verdict about the frame.
  surface.claims = {{Measure::SampleError, 1.0, Unit::Pixel},
                    {Measure::SurfaceError, 1.0, Unit::Pixel},
                    {Measure::PixelError, 1.0, Unit::Pixel},
                    {Measure::SampleError, 0.0, Unit::Metre, Scope::Patch, 0}};
  const AuditResult result = audit(field, surface, vertical_view(320, 100, false),
                                   {"pixel-error=1m", "nearest-error=1px"});
  EXPECT_EQ(result.verdict(), Verdict::None);
  EXPECT_FALSE(result.holds());
  EXPECT_EQ(result.patch_claims, 1);
  for (const ClaimResult& c : result.claims) {
    if (c.claim.scope == Scope::Patch) continue;
    EXPECT_FALSE(c.is_measured) << c.label;
    EXPECT_EQ(c.verdict(), Verdict::None) << c.label;
    EXPECT_EQ(c.tightness(), std::nullopt) << c.label;
  }
  EXPECT_EQ(verdict_sentence(result),
            "No verdict: nothing of the terrain is in view of this camera.");
  EXPECT_TRUE(result.offenders.empty());
}

TEST(Verdict, IsOfTheClaimsThatCouldBeMeasured) {
  const terrain::Heightfield field = plane(33);
  DrawnSurface surface = full_detail(field);
  surface.claims = {{Measure::SampleError, 1.0, Unit::Metre}};
  const AuditResult result = audit(field, surface, vertical_view(320, 100, false));
  EXPECT_EQ(result.verdict(), Verdict::Held);
  EXPECT_TRUE(claim(result, "sample-error").holds);
  EXPECT_FALSE(claim(result, "coverage").is_measured);
  EXPECT_EQ(verdict_sentence(result),
            "Every claim that could be measured holds: 1 of the frame and 0 of patches; not "
            "measured: coverage.");
}

// A picture that shows something where there is nothing is measured, and broken.
TEST(Verdict, IsBrokenWhereSomethingIsDrawnIntoTheSky) {
  const AuditResult result = audit(plane(33), sheet(320, 500.0), vertical_view(320, 100, false));
  EXPECT_TRUE(claim(result, "coverage").is_broken());
  EXPECT_EQ(result.verdict(), Verdict::Broken);
}

TEST(Verdict, IsNoneForATerrainWithoutASurface) {
  terrain::Heightfield empty = plane(5);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) empty.heights_m.floats()(i, j) = kVoid;
  }
  for (const auto& [field, words] : {std::pair(empty, "5 x 5 samples, 25 of them void"),
                                     std::pair(plane(1), "1 x 1 samples, 0 of them void")}) {
    const AuditResult result =
        audit(field, full_detail(field), vertical_view(40, 100), {"topology=0", "sample-error=1m"});
    EXPECT_EQ(result.verdict(), Verdict::None);
    EXPECT_NE(verdict_sentence(result).find(words), std::string::npos) << verdict_sentence(result);
  }
}

// From 1 m above the middle of a cell no sample is in view, but the middle of the cell's diagonal,
// where the other diagonal crosses it. From above the middle of a triangle that is out of view too.
TEST(Verdict, KnowsOfPlacesBetweenTheSamples) {
  const terrain::Heightfield field = plane(3);
  const DrawnSurface surface = full_detail(field, terrain::Diagonal::Fixed);
  for (const bool over_diagonal : {true, false}) {
    LookAt look;
    look.eye_m = {5, over_diagonal ? 5 : 2, 1};
    look.target_m = {look.eye_m.x, look.eye_m.y, 0};
    look.width_px = look.height_px = 50;
    const AuditResult result =
        audit(field, surface, make_camera(look), {"surface-error=1px", "sample-error=1px"});
    EXPECT_FALSE(claim(result, "sample-error").is_measured);
    EXPECT_EQ(claim(result, "surface-error").is_measured, over_diagonal);
    EXPECT_EQ(result.verdict(), Verdict::Held);  // of coverage, at least
  }
}

}  // namespace
}  // namespace plumb::audit
