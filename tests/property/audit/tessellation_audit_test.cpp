// What the conservative tessellation promises, from any place, in pixels and in metres.
#include <gtest/gtest.h>

#include <cstdio>

#include "support/tessellation_views.h"
#include "support/test_terrain.h"

namespace plumb::audit {
namespace {

using mesh::tessellation::Parameters;
using mesh::tessellation::Prepared;
using terrain::Diagonal;
using test_support::Random;
using test_support::rough_terrain;
using test_support::tessellation_with;
using test_support::View;

struct Scene {
  int columns, rows;
  double void_share;
  Parameters parameters;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << scene.columns << " x " << scene.rows << ", voids " << scene.void_share
             << ", patches of " << scene.parameters.patch_cells << ", blocks of "
             << scene.parameters.block_cells;
}

Parameters chunked() {
  Parameters parameters = tessellation_with(0.1, 16);
  parameters.fine_selection = false;
  return parameters;
}

const Scene kScenes[] = {
    {129, 97, 0.0, tessellation_with(0.0, 32)},
    {129, 97, 0.0, tessellation_with(1.0, 16, 8, 1)},
    {100, 131, 0.0, tessellation_with(0.5, 8)},
    {130, 120, 0.0, tessellation_with(0.5, 32, 16)},
    {161, 90, 0.0, tessellation_with(0.1, 64, 64)},
    {97, 80, 0.01, tessellation_with(0.2, 16)},
    {120, 97, 0.01, chunked()},
    {67, 65, 0.2, tessellation_with(0.0, 8, 8, 1)},
    {2, 2, 0.0, tessellation_with(0.1, 16)},
    {3, 200, 0.0, tessellation_with(0.1, 16)},
    {200, 3, 0.02, tessellation_with(0.1, 8)},
};

// What all results together were about.
struct Seen {
  int judged = 0, unreachable = 0;
  std::int64_t patches = 0, skirts_from_below = 0;
  double tightest = 1e9;  // claimed by measured, of the frames' sample errors
};

// Skirts are made for eyes above the ground. From underneath one is seen whole, below its patch's
// rim by as much as both patches may stray.
bool is_skirt_below_ground(const DrawnSurface& surface, const AuditResult& result,
                           std::size_t pixel) {
  if (!result.drawn.hit(pixel)) return false;
  const int patch = patch_of(surface, result.drawn.primitive[pixel]);
  return surface.patches[static_cast<std::size_t>(patch)].kind == 1 &&
         !(result.pixels.vertical_m[pixel] >= 0.0f);
}

enum class Eye { Anywhere, AboveGround };

struct Frame {
  const HeightfieldTruth& truth;
  const Prepared& prepared;
  Camera camera;
  Tolerance tolerance;
};

// Pixels that break a claim of the frame.
bool breaks(const ClaimResult& claim, const AuditResult& result, std::size_t pixel) {
  if (claim.claim.measure == Measure::Coverage)
    return result.coverage.defects[pixel] != DefectKind::None;
  return result.pixels.vertical_px[pixel] > claim.claim.bound + claim.slack;
}

void expect_kept(const Frame& frame, Eye eye, Seen& seen) {
  const DrawnSurface surface =
      mesh::tessellation::draw(frame.prepared, frame.camera, frame.tolerance);
  AuditOptions options;
  options.nearest = false;
  options.band = test_support::band_of(surface, frame.tolerance);
  const AuditResult result = audit_surface(frame.truth, surface, frame.camera, options);
  for (const ClaimResult& each : result.claims) {
    seen.unreachable += each.claim.unreachable;
    if (!each.is_broken()) continue;
    const bool of_pixels =
        each.claim.measure == Measure::PixelError || each.claim.measure == Measure::Coverage;
    for (std::size_t k = 0; of_pixels && eye == Eye::Anywhere && k < result.drawn.size(); ++k) {
      if (!breaks(each, result, k)) continue;
      ++seen.skirts_from_below;
      EXPECT_TRUE(is_skirt_below_ground(surface, result, k)) << each.label;
    }
    if (of_pixels && eye == Eye::Anywhere) continue;
    ADD_FAILURE() << each.label << ": claimed " << each.claim.bound << name_of(each.claim.unit)
                  << ", measured " << each.measured << " in " << each.violations
                  << " places, asked for " << to_text(frame.tolerance);
  }
  EXPECT_EQ(result.patch_claims_broken, 0);
  EXPECT_EQ(result.samples.over_void, 0);
  EXPECT_EQ(result.samples.uncovered, 0);
  seen.judged += result.verdict() == Verdict::Held;
  seen.patches += result.patch_claims;
  const ClaimResult* samples = test_support::frame_claim(result, "sample-error");
  if (samples != nullptr && samples->tightness() && !samples->claim.unreachable)
    seen.tightest = std::min(seen.tightest, *samples->tightness());
}

// Over the terrain, above all of it, looking anywhere but up.
Camera camera_above(Random& random, const terrain::Heightfield& field) {
  const Box box = terrain::bounds(field);
  LookAt look;
  look.eye_m = {random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
                box.high.z + random.uniform(1.0, 300.0)};
  look.target_m = {random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
                   random.uniform(box.low.z, box.high.z)};
  look.eye_m += field.world_origin_m();
  look.target_m += field.world_origin_m();
  look.fov_y_deg = random.uniform(20.0, 90.0);
  look.width_px = 97;
  look.height_px = 71;
  return make_camera(look);
}

Seen look_at(const Scene& scene, std::uint32_t seed, Eye eye, int frames) {
  Random random(seed);
  terrain::Heightfield field =
      rough_terrain(scene.columns, scene.rows, seed, 100.0, scene.void_share);
  if (seed % 2 == 0) {  // far from the origin, cells longer than wide
    field.origin_m = {5e5, 4.5e6};
    field.dy_m = 17.0;
  }
  const HeightfieldTruth truth(field, Diagonal::Blocks8);
  const Prepared prepared = mesh::tessellation::prepare(field, scene.parameters);
  Seen seen;
  for (int k = 0; k < frames; ++k) {
    const auto view = static_cast<View>(k % static_cast<int>(View::Count));
    const Camera camera = eye == Eye::AboveGround
                              ? camera_above(random, field)
                              : test_support::random_camera(random, field, view, 97, 71);
    const Tolerance tolerance = k % 3 == 2 ? Tolerance{random.uniform(0.0, 25.0), Unit::Metre}
                                           : Tolerance{random.uniform(0.3, 6.0), Unit::Pixel};
    SCOPED_TRACE(testing::Message() << scene << ", seed " << seed << ", frame " << k);
    expect_kept({truth, prepared, camera, tolerance}, eye, seen);
  }
  return seen;
}

void look_at_all(Eye eye) {
  for (const Scene& scene : kScenes) {
    Seen all;
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      const Seen seen = look_at(scene, seed, eye, 15);
      all.judged += seen.judged;
      all.unreachable += seen.unreachable;
      all.patches += seen.patches;
      all.skirts_from_below += seen.skirts_from_below;
      all.tightest = std::min(all.tightest, seen.tightest);
    }
    std::printf(
        "%d x %d: %d frames held, %d claims out of reach, %d patches, %d pixels of skirts from "
        "below; tightest %.3f\n",
        scene.columns, scene.rows, all.judged, all.unreachable, static_cast<int>(all.patches),
        static_cast<int>(all.skirts_from_below), all.tightest);
    EXPECT_GT(all.judged, 20);
  }
}

TEST(TessellationAudit, KeepsEveryClaimFromAboveTheGround) { look_at_all(Eye::AboveGround); }

TEST(TessellationAudit, KeepsEveryClaimFromAnywhereButForSkirtsFromBelow) {
  look_at_all(Eye::Anywhere);
}

}  // namespace
}  // namespace plumb::audit
