// Where tessellation fails, by name: what the published rules miss, and that the conservative ones
// keep their promise all the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/tessellation/patch_selection.h"
#include "support/tessellation_views.h"
#include "support/test_terrain.h"

namespace plumb::audit {
namespace {

using namespace mesh::tessellation;
using mesh::patch_quadtree::PatchPlace;
using terrain::Diagonal;
using terrain::Heightfield;
using test_support::audit_tessellation;
using test_support::frame_claim;
using test_support::rough_terrain;
using test_support::tessellation_with;

constexpr double kSpacing_m = 10.0;

Heightfield ground(int columns, int rows, const std::function<double(int, int)>& height) {
  Heightfield field;
  field.heights_m = Grid<float>(columns, rows);
  field.dx_m = field.dy_m = kSpacing_m;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i)
      field.heights_m.floats()(i, j) = static_cast<float>(height(i, j));
  }
  return field;
}

Camera view(const glm::dvec3& eye_m, const glm::dvec3& target_m, double near_m = 0.5) {
  return make_camera({.eye_m = eye_m,
                      .target_m = target_m,
                      .fov_y_deg = 60.0,
                      .width_px = 160,
                      .height_px = 120,
                      .near_m = near_m});
}

AuditResult look(const Heightfield& field, Parameters parameters, Variant variant,
                 const Camera& camera, const Tolerance& tolerance) {
  parameters.variant = variant;
  return audit_tessellation(HeightfieldTruth(field, Diagonal::Blocks8), prepare(field, parameters),
                            camera, tolerance);
}

// Returns the result, for what a scene is about.
AuditResult expect_kept(const Heightfield& field, const Parameters& parameters,
                        const Camera& camera, const Tolerance& tolerance = {}) {
  AuditResult result = look(field, parameters, Variant::Conservative, camera, tolerance);
  EXPECT_TRUE(result.holds());
  EXPECT_EQ(result.patch_claims_broken, 0);
  EXPECT_EQ(result.coverage.defect_count(), 0);
  EXPECT_EQ(result.samples.over_void + result.samples.uncovered, 0);
  return result;
}

void expect_broken_and_mended(const Heightfield& field, Parameters parameters, Cause cause,
                              const Camera& camera, const Tolerance& tolerance = {}) {
  const AuditResult printed = look(field, parameters, Variant::Published, camera, tolerance);
  parameters.mends[static_cast<std::size_t>(cause)] = true;
  const AuditResult mended = look(field, parameters, Variant::Published, camera, tolerance);
  const ClaimResult &before = *frame_claim(printed, "sample-error"),
                    &after = *frame_claim(mended, "sample-error");
  EXPECT_TRUE(before.is_broken());
  EXPECT_LT(after.violations, before.violations);
  EXPECT_LE(after.measured, before.measured);
}

// The eye hangs over the middle of the side that the spike's block shares with the next: there a
// vertical length is a point on the screen, and the whole block is drawn by that side's word.
TEST(TessellationFails, StraightDownOverASpike) {
  const Heightfield field =
      ground(17, 17, [](int i, int j) { return i == 2 && j == 2 ? 30.0 : 0.0; });
  const Camera camera = view({80, 40, 200}, {80, 40, 0});
  expect_kept(field, tessellation_with(0.001, 16), camera);
  expect_broken_and_mended(field, tessellation_with(0.001, 16), Cause::ViewFromAbove, camera);
}

// Blocks of 640 m: the eye stands over one, the middles of most of its sides are behind it.
TEST(TessellationFails, WithAnEdgesMidpointBehindTheCamera) {
  const Heightfield field = rough_terrain(129, 129, 3);
  const Camera camera = view({330, 500, 130}, {330, 900, 60});
  expect_kept(field, tessellation_with(0.05, 64, 64), camera, {2.0, Unit::Pixel});
  expect_broken_and_mended(field, tessellation_with(0.05, 64, 64), Cause::EdgeMidpoint, camera,
                           {2.0, Unit::Pixel});
}

TEST(TessellationFails, WithABlockAcrossTheNearPlane) {
  const Heightfield field = rough_terrain(97, 97, 4);
  for (const double near_m : {1.0, 60.0, 300.0}) {
    for (const double pixels : {0.5, 3.0}) {
      expect_kept(field, tessellation_with(0.05, 16), view({200, 200, 120}, {700, 600, 40}, near_m),
                  {pixels, Unit::Pixel});
    }
  }
}

// Everything is coded as one height: what is asked for is out of reach, and the claim says by how
// much.
TEST(TessellationFails, WithADeltaLargerThanTheRelief) {
  const Heightfield field = rough_terrain(65, 65, 5, 20.0);
  for (const std::uint32_t version : {1u, 2u}) {
    const AuditResult result = expect_kept(field, tessellation_with(500.0, 16, 8, version),
                                           view({300, -200, 300}, {320, 320, 0}));
    const ClaimResult* samples = frame_claim(result, "sample-error");
    ASSERT_NE(samples, nullptr);
    EXPECT_TRUE(samples->claim.unreachable);
    EXPECT_GT(samples->claim.bound, 1.0);
    EXPECT_LE(samples->measured, samples->claim.bound);
  }
}

TEST(TessellationFails, WithHeightsBelowZero) {
  for (const double base_m : {-50.0, -4000.0}) {
    Heightfield field = rough_terrain(97, 80, 6);
    for (float& height : field.heights_m.floats().values()) height += static_cast<float>(base_m);
    for (const std::uint32_t version : {1u, 2u})
      expect_kept(field, tessellation_with(0.3, 16, 8, version),
                  view({100, -100, base_m + 250.0}, {480, 400, base_m}));
  }
}

// Walls on odd columns are in no level but the finest; the bounds of the others know of them.
TEST(TessellationFails, ToDrawWallsThatDecimationLoses) {
  const Heightfield field = ground(65, 65, [](int i, int) { return i % 16 == 9 ? 40.0 : 0.0; });
  const Parameters parameters = tessellation_with(0.01, 8);
  const Prepared prepared = prepare(field, parameters);
  const auto& layout = prepared.header().layout;
  for (std::int64_t k = 0; k < layout.patch_count(); ++k) {
    const PatchPlace place = layout.place(k);
    if (place.level == 0) continue;  // the others span 16 columns or more, and a wall
    EXPECT_GE(prepared.bounds->error_m(k), 40.0);
    const Grid<float> heights_m = prepared.decoder->heights(place);
    for (const float height : heights_m.values()) EXPECT_LT(height, 1.0f);
  }
  expect_kept(field, parameters, view({320, -300, 200}, {320, 320, 0}));
  expect_kept(field, parameters, view({320, 320, 900}, {320, 320, 0}), {30.0, Unit::Pixel});
}

// A valley along a diagonal of the root's cells, of 2 x 2 of the terrain's: all samples lie on
// the root's triangles. But beyond column 4 the terrain's own diagonals fall across the valley:
// from 4 m to 4 m over the root's 0 m.
TEST(TessellationFails, OnASaddleUnderAParentsDiagonal) {
  const Heightfield field = ground(9, 10, [](int i, int j) { return 4.0 * std::abs(i - 4 - j); });
  const Parameters parameters = tessellation_with(0.001, 8);
  const Prepared prepared = prepare(field, parameters);
  ASSERT_EQ(prepared.header().layout.levels, 2);
  EXPECT_GE(prepared.bounds->error_m(0), 4.0);
  const Camera camera = view({40, -60, 120}, {40, 45, 0});
  const AuditResult coarse = expect_kept(field, parameters, camera, {5.0, Unit::Metre});
  EXPECT_LE(coarse.samples.worst_m.error, 0.002);
  EXPECT_NEAR(coarse.edges.max_m, 4.0, 0.002);
  const AuditResult fine = expect_kept(field, parameters, camera, {3.0, Unit::Metre});
  EXPECT_LE(fine.edges.max_m, 0.002);
}

TEST(TessellationFails, AroundHolesOfNoData) {
  for (const double share : {0.003, 0.05, 0.4}) {
    const Heightfield field = rough_terrain(97, 91, 7, 100.0, share);
    for (const double pixels : {1.0, 5.0})
      expect_kept(field, tessellation_with(0.05, 16), view({450, 100, 250}, {480, 500, 0}),
                  {pixels, Unit::Pixel});
  }
}

// Levels of patches that share a side; the largest difference.
int largest_step(const Prepared& prepared, const PatchSelection& selection) {
  const auto& layout = prepared.header().layout;
  int largest = 0;
  for (const PatchPlace& a : selection.drawn) {
    for (const PatchPlace& b : selection.drawn) {
      const auto covers = [&](int x, int y, const PatchPlace& p) {
        const int n = layout.patch_cells << p.level;
        return x >= p.px * n && x < (p.px + 1) * n && y >= p.py * n && y < (p.py + 1) * n;
      };
      // A cell just beyond a's western, or southern side.
      const int n = layout.patch_cells << a.level;
      if (covers(a.px * n - 1, a.py * n, b) || covers(a.px * n, a.py * n - 1, b))
        largest = std::max(largest, std::abs(a.level - b.level));
    }
  }
  return largest;
}

// Rough in one corner, a gentle slope elsewhere: patches of far levels side by side, T-junctions
// along every such side, and what closes them.
TEST(TessellationFails, BetweenPatchesTwoLevelsApart) {
  const Heightfield rough = rough_terrain(257, 257, 8, 60.0);
  const Heightfield field = ground(257, 257, [&](int i, int j) {
    return i < 40 && j < 40 ? double{rough.heights_m(i, j)} : 30.0 + 0.0625 * i;
  });
  const Parameters parameters = tessellation_with(0.01, 16);
  const Prepared prepared = prepare(field, parameters);
  for (const glm::dvec3& eye : {glm::dvec3(500, 500, 150), {60, 700, 150}, {200, 200, 250}}) {
    const Camera camera = view(eye, {390, 390, 30});
    EXPECT_GE(largest_step(prepared, select_patches(prepared, {camera, {1.0, Unit::Pixel}})), 2);
    const AuditResult result =
        look(field, parameters, Variant::Conservative, camera, {1.0, Unit::Pixel});
    for (const ClaimResult& each : result.claims) EXPECT_FALSE(each.is_broken()) << each.label;
  }
}

// Hardware cuts a side into 64 at most: a block may have as many cells, and no more.
TEST(TessellationFails, BeyondAFactorOf64) {
  const Heightfield field = rough_terrain(129, 129, 9);
  expect_kept(field, tessellation_with(0.05, 128, 64), view({600, -100, 300}, {640, 600, 0}),
              {6.0, Unit::Pixel});
  EXPECT_EQ(BlockPieces(64).strip(0, North, 0).size(), 64u + 62u);
  EXPECT_THROW(prepare(field, tessellation_with(0.05, 128, 128)), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::audit
