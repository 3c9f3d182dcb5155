// Frames of slices and polygons beside the truth: what they promise where they draw, and no holes.
#include "slicing/hybrid_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/screen_error.h"
#include "reference/pyramid_caster.h"
#include "reference/surface_height.h"
#include "support/random_slices.h"
#include "terrain/camera_presets.h"

namespace plumb::slicing {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::Random;

const SliceBundle& bundle_of(const SlicingCut& cut, std::uint32_t node) {
  return *std::find_if(cut.bundles.begin(), cut.bundles.end(),
                       [&](const SliceBundle& bundle) { return bundle.node == node; });
}

// The truth's hit, seen from above: a ray that meets the sheet from below, or only behind what is
// drawn, got below the ground without crossing it (round the rim, through a void). The truth is a
// sheet there, slices are a solid.
bool enters_from_above(const HitImage& truth, std::size_t pixel, double depth_m,
                       const Heightfield& field) {
  if (!(truth.depth_m[pixel] <= depth_m * (1.0 + 1e-6))) return false;
  const glm::dvec3 normal =
      reference::triangle_normal(field, Diagonal::Alternating, truth.primitive[pixel]);
  return glm::dot(normal, truth.from_eye_m[pixel]) < 0.0;
}

// What a conservative frame promises of every pixel that it draws: the ground straight above or
// below is at most the tolerance away, and hardly ever below.
TEST(HybridFrame, KeepsItsPromiseWhereItDraws) {
  Random random(43);
  std::int64_t sliced = 0, set_aside = 0;
  double most = 0.0;
  for (std::uint32_t round = 0; round < 150; ++round) {
    const Heightfield field = test_support::random_ground(random, round);
    const SlicingTree tree(field, Diagonal::Alternating);
    const Camera camera = test_support::random_view(random, field);
    const Camera local = relative_to(camera, field.world_origin_m());
    CutOptions options = test_support::random_cut_options(random);
    options.variant = Variant::Conservative;
    const SlicingCut cut = cut_tree(tree, local, options);
    const HeightLookup heights(field, Diagonal::Alternating);
    const HybridFrame frame =
        draw_frame(tree, cut, mesh_of_nodes(tree, cut.polygons), camera, heights);
    const HitImage truth =
        reference::PyramidCaster(field, Diagonal::Alternating).cast_frame(camera);
    for (std::size_t pixel = 0; pixel < frame.image.size(); ++pixel) {
      const std::uint32_t node = frame.image.primitive[pixel];
      if (!frame.image.hit(pixel) || cut.use[node] != NodeUse::Bundle) continue;
      const glm::dvec3 point = local.eye_m + frame.image.from_eye_m[pixel];
      const double above = heights.height_m(point.x, point.y) - point.z;
      const double raise_m = bundle_of(cut, node).closing_raise_m;
      if (above > 0.0 && !enters_from_above(truth, pixel, frame.image.depth_m[pixel], field)) {
        ++set_aside;
        continue;
      }
      ++sliced;
      ASSERT_GE(above, -raise_m * (1.0 + 1e-9)) << round;
      const double error = screen_displacement_px(local, point, {0, 0, 1}, above);
      most = std::max(most, error / options.tolerance_px);
      ASSERT_LE(error, options.tolerance_px * (1.0 + 1e-9)) << round;
    }
  }
  EXPECT_GT(sliced, 10'000);
  EXPECT_LT(set_aside, sliced / 20);
  EXPECT_GT(most, 0.5);  // and does not promise far too little
}

// And of those that it does not: the truth is met there within the tolerance of a silhouette alone,
// so never where the truth's neighbours all around are met as well, two pixels wide. Returns the
// pixels that were looked at.
std::int64_t expect_no_holes(const Heightfield& field, const Camera& camera,
                             const CutOptions& options, const std::string& what) {
  const SlicingTree tree(field, Diagonal::Alternating);
  const SlicingCut cut = cut_tree(tree, relative_to(camera, field.world_origin_m()), options);
  const HybridFrame frame = draw_frame(tree, cut, mesh_of_nodes(tree, cut.polygons), camera,
                                       HeightLookup(field, Diagonal::Alternating));
  const HitImage truth = reference::PyramidCaster(field, Diagonal::Alternating).cast_frame(camera);
  std::int64_t terrain_pixels = 0;
  for (int y = 1; y + 1 < camera.height_px; ++y) {
    for (int x = 1; x + 1 < camera.width_px; ++x) {
      bool all = true;
      for (int b = -1; b <= 1; ++b) {
        for (int a = -1; a <= 1; ++a) all = all && truth.hit(truth.index(x + a, y + b));
      }
      if (!all) continue;
      ++terrain_pixels;
      EXPECT_TRUE(frame.image.hit(truth.index(x, y))) << what << ": " << x << ", " << y;
    }
  }
  return terrain_pixels;
}

// Over the middle of a square, rays through a diagonal's pixels meet edges where two sides of a box
// join.
TEST(HybridFrame, LeavesNoHolesWhereRaysMeetTheEdgesOfBoxes) {
  CutOptions options;
  options.variant = Variant::Conservative;
  options.hybrid = false;
  std::int64_t terrain_pixels = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const Heightfield field = test_support::rough_terrain(129, 129, seed, 60.0, 0.0, 10.0, 10.0);
    const Camera camera = make_camera(terrain::preset_camera(field, "top", 201, 201, 50.0));
    terrain_pixels += expect_no_holes(field, camera, options, std::to_string(seed));
  }
  EXPECT_GT(terrain_pixels, 200'000);
}

TEST(HybridFrame, LeavesNoHoles) {
  Random random(44);
  std::int64_t terrain_pixels = 0;
  for (std::uint32_t round = 0; round < 150; ++round) {
    const Heightfield field = test_support::random_ground(random, round);
    const Camera camera = test_support::random_view(random, field);
    if (camera.eye_m.z < 130.0) continue;  // below the ground there is a solid, and no sheet
    CutOptions options = test_support::random_cut_options(random);
    options.variant = Variant::Conservative;
    options.tolerance_px = 1.0;
    terrain_pixels += expect_no_holes(field, camera, options, std::to_string(round));
  }
  EXPECT_GT(terrain_pixels, 20'000);
}

// Level ground is met exactly by published slices, and by conservative ones down to the bottom of
// their reach: one plane is enough for either.
TEST(HybridFrame, NeedsOnePlaneForLevelGround) {
  Heightfield field;
  field.heights_m = Grid<float>(129, 129, 5.0f);
  field.dx_m = field.dy_m = 10.0;
  const SlicingTree tree(field, Diagonal::Alternating);
  const Camera camera = make_camera({.eye_m = {640, 640, 905},
                                     .target_m = {640, 641, 5},
                                     .fov_y_deg = 40.0,
                                     .width_px = 64,
                                     .height_px = 64});
  for (const Variant variant : {Variant::Published, Variant::Conservative}) {
    CutOptions options;
    options.variant = variant;
    options.hybrid = false;
    const SlicingCut cut = cut_tree(tree, camera, options);
    EXPECT_GT(cut.bundles.size(), 0u);
    const HybridFrame frame = draw_frame(tree, cut, mesh_of_nodes(tree, cut.polygons), camera,
                                         HeightLookup(field, Diagonal::Alternating));
    for (const SliceBundle& bundle : cut.bundles) EXPECT_EQ(bundle.count, 1);
    for (std::size_t pixel = 0; pixel < frame.image.size(); ++pixel) {
      ASSERT_TRUE(frame.image.hit(pixel));
      const std::uint32_t node = frame.image.primitive[pixel];  // polygons at the frustum's sides
      const bool sliced = cut.use[node] == NodeUse::Bundle;
      const double off_m = sliced ? bundle_of(cut, node).closing_raise_m : 0.0;  // 0 if published
      ASSERT_NEAR(camera.eye_m.z + frame.image.from_eye_m[pixel].z, 5.0, off_m + 1e-9);
    }
  }
}

}  // namespace
}  // namespace plumb::slicing
