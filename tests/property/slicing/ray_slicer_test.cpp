// The ray-slicer beside a loop over every plane.
#include "slicing/ray_slicer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/instruction_set.h"
#include "core/parallel.h"
#include "slicing/branch_walk.h"
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
        !is_on_quad(bundle, kind, axis, met.point_m))
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

// Plateaus at one height, whose triangles lie in a plane with the top of their boxes; far lower
// than a pixel, or as high as the ground was.
Heightfield with_plateaus(Random& random, Heightfield field) {
  const bool low = random.chance(0.5);
  const double highest_m = random.uniform(20.0, 100.0);
  for (float& height : field.heights_m.floats().values()) {
    if (low) {
      height = std::isnan(height) ? height : height > highest_m ? 30.0f : 29.75f;
    } else if (height > highest_m) {
      height = static_cast<float>(highest_m);
    }
  }
  return field;
}

// From low down, past the ground's highest places: rays that climb.
Camera view_upwards(Random& random, const Heightfield& field) {
  LookAt look;
  look.eye_m = field.world_origin_m() +
               glm::dvec3(field.cell_columns() * field.dx_m * random.uniform(-0.5, 1.5),
                          -random.uniform(10.0, 3000.0), random.uniform(0.0, 40.0));
  look.target_m = field.world_origin_m() + glm::dvec3(0.5 * field.cell_columns() * field.dx_m,
                                                      0.5 * field.cell_rows() * field.dy_m,
                                                      random.uniform(30.0, 80.0));
  look.fov_y_deg = random.uniform(2.0, 40.0);
  look.width_px = 48;
  look.height_px = 36;
  look.near_m = 1.0;
  return make_camera(look);
}

TEST(RaySlicer, SeesWhatALoopOverEveryPlaneSees) {
  Random random(41);
  std::int64_t hits = 0;
  for (std::uint32_t round = 0; round < 120; ++round) {
    Heightfield field = test_support::random_ground(random, round);
    if (random.chance(0.4)) field = test_support::coded_twins(random, field).coded;
    if (random.chance(0.4)) field = with_plateaus(random, field);
    const SlicingTree tree(field, Diagonal::Alternating, random.chance(0.5) ? 8 : 4);
    const Camera camera = relative_to(
        random.chance(0.3) ? view_upwards(random, field) : test_support::random_view(random, field),
        field.world_origin_m());
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

// Boxes far lower than a pixel, which slices stand out of by a pixel: there the tested height is
// that of the box's top, on which triangles lie, while the ray climbs.
TEST(RaySlicer, SeesGroundAtTheTopOfItsBoxFromBelow) {
  Random random(47);
  Heightfield field;
  field.heights_m = Grid<float>(129, 129, 1024.0f);
  for (float& height : field.heights_m.floats().values())
    height -= random.chance(0.4) ? 0.25f : 0.0f;
  field.dx_m = field.dy_m = 90.0;
  const SlicingTree tree(field, Diagonal::Alternating);
  const Camera camera = make_camera({.eye_m = {5760.0, -8000.0, 1004.0},
                                     .target_m = {5760.0, 5000.0, 1032.0},
                                     .fov_y_deg = 20.0,
                                     .width_px = 320,
                                     .height_px = 240});
  CutOptions options;
  options.variant = Variant::Published;
  options.hybrid = false;
  const SlicingCut cut = cut_tree(tree, camera, options);
  const HeightLookup heights(field, Diagonal::Alternating);
  const SlicedImage sliced = slice_rays(cut, camera, heights);
  std::int64_t hits = 0, climbing = 0;
  for (int y = 112; y < 132; ++y) {
    for (int x = 0; x < camera.width_px; x += 3) {
      const SliceRay ray(camera, x, y);
      const SliceHit expected = by_trying_all(cut, heights, ray, camera.near_m);
      const std::size_t pixel = sliced.image.index(x, y);
      ASSERT_EQ(sliced.image.depth_m[pixel], expected.t) << x << ", " << y;
      ASSERT_EQ(sliced.image.overdraw[pixel], SlowCount(cut, heights, camera, x, y).count());
      hits += expected ? 1 : 0;
      climbing += expected && ray.direction.z > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(climbing, 50);
}

}  // namespace
}  // namespace plumb::slicing
