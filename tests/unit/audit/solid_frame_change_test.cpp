// Popping of surfaces that are no heightfields, in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "audit/temporal/frame_change.h"
#include "solid_scenes.h"

namespace plumb::audit::temporal {
namespace {

// Half a metre up from 16 m below the eye: what shows o pixels off the middle goes to o * 16
// / 15.5, by o / 31, and 49.5 * sqrt(2) is the farthest pixel.
TEST(SolidFrameChange, PopsByWhatARiseSpansOnTheScreen) {
  const terrain::Heightfield field = level_ground();
  const MeshTruth truth = truth_of(field);
  const DrawnSurface exact = full_detail(field), up = with_mesh(exact, raised(*exact.mesh, 0.5));
  const Frame before(exact, from_20_m()), now(up, from_20_m());
  const AuditResult audited = audit_surface(truth, up, from_20_m());
  const FrameChange change = change_between(truth, audited, now, &before, nullptr);
  EXPECT_NEAR(change.popping->max_px, 49.5 * std::sqrt(2.0) / 31.0, 1e-9);
  EXPECT_EQ(change.popping->pixels.count, 10000);
  EXPECT_NEAR(change.popping->worst->m, 0.5, 1e-12);
  EXPECT_FALSE(change.flicker.has_value());
}

TEST(SolidFrameChange, IsNoneWhereOnlyTheCameraMoves) {
  const terrain::Heightfield field = level_ground();
  const MeshTruth truth = truth_of(field);
  const DrawnSurface exact = full_detail(field), again = with_mesh(exact, *exact.mesh);
  Camera moved = from_20_m();
  moved.eye_m.x += 0.7;
  const Frame before(exact, from_20_m()), now(again, moved);
  const FrameChange change =
      change_between(truth, audit_surface(truth, again, moved), now, &before, nullptr);
  EXPECT_GT(change.popping->pixels.count, 9000);
  EXPECT_EQ(change.popping->max_px, 0.0);
}

}  // namespace
}  // namespace plumb::audit::temporal
