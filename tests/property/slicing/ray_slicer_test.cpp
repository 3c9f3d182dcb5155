// The ray-slicer beside a loop over every plane, and its promise beside the truth.
#include "slicing/ray_slicer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/instruction_set.h"
#include "core/parallel.h"
#include "core/screen_error.h"
#include "reference/pyramid_caster.h"
#include "reference/surface_height.h"
#include "slicing/branch_walk.h"
#include "slicing/hybrid_frame.h"
#include "support/coded_terrain.h"
#include "support/every_quad.h"
#include "support/random_slices.h"

namespace plumb::slicing {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::Random;

// Every quad of every bundle, one after the other.
SliceHit by_trying_all(const SlicingCut& cut, const HeightLookup& heights, const SliceRay& ray,
                       double near_m) {
  SliceHit best;
  test_support::for_each_quad_met(
      cut, ray, near_m, [&](std::uint32_t number, QuadKind kind, Axis axis, const PlanePoint& met) {
        if (passes(cut.bundles[number], kind, axis, heights, ray, met))
          best = std::min(best, SliceHit{met.t, number});
      });
  return best;
}

// The bundles in the order in which a ray comes to them: at every branch the child nearest to where
// it starts first, the farthest last.
void in_order(const SlicingCut& cut, std::uint32_t branch, const SliceRay& ray,
              std::vector<std::uint32_t>& order) {
  const SliceBranch& here = cut.branches[branch];
  if (here.bundle != kNoPrimitive) order.push_back(here.bundle);
  for (const bool far_side : {false, true}) {
    for (const bool across : {false, true}) {
      const bool east = across != (ray.direction.x < 0.0);
      const bool north = far_side != (ray.direction.y < 0.0);
      const std::uint32_t below = here.below[2 * north + east];
      if (below != kNoPrimitive) in_order(cut, below, ray, order);
    }
  }
}

// What the ray-slicer says that it tests, counted over every quad of every bundle.
class SlowCount {
 public:
  SlowCount(const SlicingCut& cut, const HeightLookup& heights, const Camera& camera, int x, int y)
      : cut_(cut), heights_(heights), camera_(camera), ray_(camera, x, y) {}

  int count() {
    std::vector<std::uint32_t> order;
    if (!cut_.branches.empty())
      in_order(cut_, static_cast<std::uint32_t>(cut_.branches.size()) - 1, ray_, order);
    for (const std::uint32_t number : order) {
      const SliceBundle& bundle = cut_.bundles[number];
      const Interval part = inside(ray_, bundle.reach, {camera_.near_m, camera_.far_m});
      if (part.empty() || part.begin > best_.t) continue;
      const glm::dvec3 &low = bundle.reach.low, &high = bundle.reach.high;
      if (bundle.closed) {
        for (const auto& [axis, at_m] :
             {std::pair(Axis::X, low.x), std::pair(Axis::X, high.x), std::pair(Axis::Y, low.y),
              std::pair(Axis::Y, high.y), std::pair(Axis::Z, low.z)})
          is_seen(number, QuadKind::Closing, axis, at_m);
      }
      const bool ascending = ray_.direction[index_of(bundle.axis)] > 0.0;
      for (int k = 0; k < bundle.count; ++k) {
        const int j = ascending ? k : bundle.count - 1 - k;
        if (is_seen(number, QuadKind::Slice, bundle.axis, bundle.plane_m(j))) break;
      }
    }
    return tested_;
  }

 private:
  bool is_seen(std::uint32_t number, QuadKind kind, Axis axis, double at_m) {
    if (ray_.direction[index_of(axis)] == 0.0) return false;
    const SliceBundle& bundle = cut_.bundles[number];
    const PlanePoint met = meet_plane(ray_, axis, at_m);
    if (met.t < camera_.near_m || met.t > camera_.far_m || met.t > best_.t ||
        !is_on_quad(bundle, axis, met.point_m))
      return false;
    ++tested_;
    if (!passes(bundle, kind, axis, heights_, ray_, met)) return false;
    best_ = std::min(best_, SliceHit{met.t, number});
    return true;
  }

  const SlicingCut& cut_;
  const HeightLookup& heights_;
  const Camera& camera_;
  SliceRay ray_;
  SliceHit best_;
  int tested_ = 0;
};

TEST(RaySlicer, SeesWhatALoopOverEveryPlaneSees) {
  Random random(41);
  std::int64_t hits = 0;
  for (std::uint32_t round = 0; round < 120; ++round) {
    Heightfield field = test_support::random_ground(random, round);
    if (random.chance(0.4)) field = test_support::coded_twins(random, field).coded;
    const SlicingTree tree(field, Diagonal::Alternating, random.chance(0.5) ? 8 : 4);
    const Camera camera =
        relative_to(test_support::random_view(random, field), field.world_origin_m());
    const CutOptions options = test_support::random_cut_options(random);
    const SlicingCut cut = cut_tree(tree, camera, options);
    const HeightLookup heights(
        field, Diagonal::Alternating,
        static_cast<Interpolation>(random.chance(0.6) ? 0 : random.integer(1, 4)));
    const SlicedImage sliced = slice_rays(cut, camera, heights);
    std::int64_t fragments = 0;
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const SliceRay ray(camera, x, y);
        const SliceHit expected = by_trying_all(cut, heights, ray, camera.near_m);
        const std::size_t pixel = sliced.image.index(x, y);
        ASSERT_EQ(sliced.image.depth_m[pixel], expected.t) << round << ": " << x << ", " << y;
        ASSERT_EQ(sliced.image.primitive[pixel], expected.bundle);
        ASSERT_EQ(sliced.image.overdraw[pixel], SlowCount(cut, heights, camera, x, y).count());
        hits += expected ? 1 : 0;
        fragments += sliced.image.overdraw[pixel];
      }
    }
    EXPECT_EQ(sliced.fragments, fragments);
    for (const InstructionSet set : available_instruction_sets()) {
      const ForcedInstructionSet forced(set);
      const SlicedImage again = slice_rays(cut, camera, heights);
      EXPECT_EQ(again.image.depth_m, sliced.image.depth_m) << name_of(set);
      EXPECT_EQ(again.image.primitive, sliced.image.primitive) << name_of(set);
      EXPECT_EQ(again.image.overdraw, sliced.image.overdraw) << name_of(set);
    }
    for (const int threads : {1, 7}) {
      const ThreadLimit limit(threads);
      const SlicedImage again = slice_rays(cut, camera, heights);
      EXPECT_EQ(again.image.depth_m, sliced.image.depth_m);
      EXPECT_EQ(again.image.overdraw, sliced.image.overdraw);
    }
  }
  EXPECT_GT(hits, 20'000);
}

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
// so never where the truth's neighbours all around are met as well, two pixels wide.
TEST(HybridFrame, LeavesNoHoles) {
  Random random(44);
  std::int64_t terrain_pixels = 0;
  for (std::uint32_t round = 0; round < 150; ++round) {
    const Heightfield field = test_support::random_ground(random, round);
    const SlicingTree tree(field, Diagonal::Alternating);
    const Camera camera = test_support::random_view(random, field);
    if (camera.eye_m.z < 130.0) continue;  // below the ground there is a solid, and no sheet
    CutOptions options = test_support::random_cut_options(random);
    options.variant = Variant::Conservative;
    options.tolerance_px = 1.0;
    const SlicingCut cut = cut_tree(tree, relative_to(camera, field.world_origin_m()), options);
    const HybridFrame frame = draw_frame(tree, cut, mesh_of_nodes(tree, cut.polygons), camera,
                                         HeightLookup(field, Diagonal::Alternating));
    const HitImage truth =
        reference::PyramidCaster(field, Diagonal::Alternating).cast_frame(camera);
    for (int y = 1; y + 1 < camera.height_px; ++y) {
      for (int x = 1; x + 1 < camera.width_px; ++x) {
        bool all = true;
        for (int b = -1; b <= 1; ++b) {
          for (int a = -1; a <= 1; ++a) all = all && truth.hit(truth.index(x + a, y + b));
        }
        if (!all) continue;
        ++terrain_pixels;
        ASSERT_TRUE(frame.image.hit(truth.index(x, y))) << round << ": " << x << ", " << y;
      }
    }
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
