// The formulas of the article, computed by hand.
#include "slicing/bundle_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slicing/slicing_cut.h"
#include "support/test_terrain.h"

namespace plumb::slicing {
namespace {

// A box of 80 x 80 m, 30 m high, of 8 x 8 cells.
SlicingNode box_node() {
  SlicingNode node;
  node.box = {{0, 0, 0}, {80, 80, 30}};
  node.i1 = node.j1 = 8;
  node.steepest = 2.0;
  return node;
}

// 1000 pixels across one unit at depth one, looking at the box.
Camera looking_at(const SlicingNode& node, const glm::dvec3& eye_m) {
  const double fov_deg = 2.0 * std::atan(0.5) * 180.0 / 3.14159265358979323846;
  Camera camera = make_camera({.eye_m = eye_m,
                               .target_m = 0.5 * (node.box.low + node.box.high),
                               .fov_y_deg = fov_deg,
                               .width_px = 1000,
                               .height_px = 1000});
  camera.gamma_h = camera.gamma_v = 1000.0;
  return camera;
}

// Level with the box's foot, 400 m west of its west side: the nearest corners are (0, 0, 0) and
// (0, 80, 0), 40 m to either side.
TEST(BundleChoice, SlicesVerticallyWhereTheViewIsLevel) {
  const SlicingNode node = box_node();
  const glm::dvec3 eye(-400, 40, 0);
  const BoxView view = view_of_box(node.box, looking_at(node, eye), Variant::Published);
  EXPECT_DOUBLE_EQ(view.distance_m, std::sqrt(400.0 * 400 + 40 * 40));
  EXPECT_EQ(view.cos_least, 1.0);  // the eye's height is the box's lowest
  EXPECT_DOUBLE_EQ(view.sin_most, 30.0 / std::sqrt(400.0 * 400 + 40 * 40 + 30 * 30));
  const CostProfile profile;
  const Camera camera = looking_at(node, eye);
  const auto priced = price_bundle(node, 7, camera, Variant::Published, 1.0, profile);
  ASSERT_TRUE(priced);
  EXPECT_EQ(priced->bundle.node, 7u);
  EXPECT_EQ(priced->bundle.axis, Axis::X);
  // x'(80, 402.0, 1) = 1000 * 80 / 401.995 = 199.007.
  EXPECT_EQ(priced->bundle.count, 200);
  EXPECT_EQ(priced->bundle.first_m, 0.0);
  EXPECT_DOUBLE_EQ(priced->bundle.spacing_m, 0.4);
  EXPECT_FALSE(priced->bundle.closed);
  // Half of a pixel at min l.
  EXPECT_DOUBLE_EQ(priced->bundle.raise_m, 0.5 * view.distance_m / 1000.0);
  EXPECT_EQ(priced->bundle.reach, node.box);  // 30 m are far more than a pixel
  const double pixels_per_m2 = 1e6 / (view.distance_m * view.distance_m);
  EXPECT_DOUBLE_EQ(priced->cost_s, 200 * (4 / 9.5e6 + 80.0 * 30.0 * 1.0 / 157e6 * pixels_per_m2));
  // 4 x 4 fans of ten vertices.
  EXPECT_DOUBLE_EQ(cost_of_polygons_s(node, view, camera, profile),
                   160 / 9.5e6 + 6400.0 * view.sin_most / 157e6 * pixels_per_m2);
}

// 470 m straight above: the nearest corners are those of the top.
TEST(BundleChoice, SlicesLevelFromAbove) {
  const SlicingNode node = box_node();
  const glm::dvec3 eye(40, 40, 500);
  const BoxView view = view_of_box(node.box, looking_at(node, eye), Variant::Published);
  EXPECT_DOUBLE_EQ(view.distance_m, std::sqrt(470.0 * 470 + 2 * 40 * 40));
  const double least_sine = 470.0 / view.distance_m;
  EXPECT_DOUBLE_EQ(view.cos_least, std::sqrt(1.0 - least_sine * least_sine));
  EXPECT_EQ(view_of_box(node.box, looking_at(node, eye), Variant::Conservative).distance_m,
            470.0);  // of the box itself
  const auto priced =
      price_bundle(node, 0, looking_at(node, eye), Variant::Published, 1.0, CostProfile{});
  ASSERT_TRUE(priced);
  EXPECT_EQ(priced->bundle.axis, Axis::Z);
  // x'(30, 473.4, 0.1195) = 7.57
  EXPECT_EQ(priced->bundle.count, 8);
  const double pixel_m = view.distance_m / 1000.0;
  EXPECT_EQ(priced->bundle.reach.low, glm::dvec3(-pixel_m, -pixel_m, 0));
  EXPECT_EQ(priced->bundle.reach.high, glm::dvec3(80 + pixel_m, 80 + pixel_m, 30));
  // Twice the gap takes half the planes.
  EXPECT_EQ(price_bundle(node, 0, looking_at(node, eye), Variant::Published, 2.0, CostProfile{})
                ->bundle.count,
            4);
}

TEST(BundleChoice, GivesLowVerticalSlicesABorder) {
  SlicingNode node = box_node();
  node.box.high.z = 0.1;  // a quarter of a pixel at 400 m
  const auto priced = price_bundle(node, 0, looking_at(node, {-400, 40, 0.05}), Variant::Published,
                                   1.0, CostProfile{});
  ASSERT_TRUE(priced);
  const double pixel_m = std::sqrt(400.0 * 400 + 40 * 40 + 0.05 * 0.05) / 1000.0;
  EXPECT_DOUBLE_EQ(priced->bundle.reach.low.z, -pixel_m);
  EXPECT_DOUBLE_EQ(priced->bundle.reach.high.z, 0.1 + pixel_m);
  EXPECT_EQ(priced->bundle.least_z_m, 0.0);
  EXPECT_EQ(priced->bundle.greatest_z_m, 0.1);
  const auto bare = price_bundle(node, 0, looking_at(node, {-400, 40, 0.05}), Variant::Published,
                                 1.0, CostProfile{}, false);
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->bundle.reach.low, node.box.low);
  EXPECT_EQ(bare->bundle.reach.high, node.box.high);
  EXPECT_EQ(bare->bundle.raise_m, priced->bundle.raise_m);
}

// For z it is 1 + L cot(alpha): at a corner 300 m down and 400 m away, slope 2, 1 + 2 * 4 / 3.
TEST(BundleChoice, DepthChangesAsTheSlopeOfGroundAndRaySay) {
  const Box box{{400, 0, 0}, {400, 0, 0}};
  EXPECT_DOUBLE_EQ(depth_change(box, 2.0, {0, 0, 300}, Axis::Z), 1.0 + 2.0 * 4.0 / 3.0);
  EXPECT_DOUBLE_EQ(depth_change(box, 2.0, {0, 0, 300}, Axis::X), (2.0 * 400 + 300) / 400.0);
  EXPECT_EQ(depth_change(box, 2.0, {0, 0, 300}, Axis::Y), INFINITY);
  EXPECT_EQ(depth_change(box_node().box, 2.0, {40, 40, 10}, Axis::Z),
            INFINITY);  // the eye in the box
}

TEST(SlicingCut, RefusesWhatIsNoQuestion) {
  const terrain::Heightfield field = test_support::rough_terrain(33, 33, 1, 5.0, 0.0, 10.0, 10.0);
  const SlicingTree tree(field, terrain::Diagonal::Alternating);
  const Camera camera = make_camera({.eye_m = {-100, -100, 100}, .target_m = {160, 160, 0}});
  CutOptions options;
  options.tolerance_px = 0.0;
  EXPECT_THROW(cut_tree(tree, camera, options), std::invalid_argument);
  options = {};
  options.descend_factor = 0.0;
  EXPECT_THROW(cut_tree(tree, camera, options), std::invalid_argument);
  options = {};
  options.profile.pixels_per_s = -1.0;
  EXPECT_THROW(cut_tree(tree, camera, options), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::slicing
