#include "slicing/profile_measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "support/test_terrain.h"
#include "terrain/camera_presets.h"

namespace plumb::slicing {
namespace {

TEST(ProfileMeasurement, IsWhatWasDrawnByTheTimeThatItTook) {
  ProfileMeasurement measured;
  measured.vertices = 3000;
  measured.vertices_s = 0.5;
  measured.fragments = 800;
  measured.fragments_s = 0.25;
  const CostProfile profile = measured.profile("mine");
  EXPECT_EQ(profile.name, "mine");
  EXPECT_EQ(profile.vertices_per_s, 6000.0);
  EXPECT_EQ(profile.pixels_per_s, 3200.0);
  EXPECT_THROW(ProfileMeasurement{}.profile("nothing"), std::invalid_argument);
}

TEST(ProfileMeasurement, CountsTheWholeTerrainAndItsSlices) {
  const terrain::Heightfield field = test_support::rough_terrain(65, 65, 3, 200.0);
  const SlicingTree tree(field, terrain::Diagonal::Alternating);
  const Camera camera = make_camera(terrain::preset_camera(field, "oblique", 64, 36, 50.0));
  const ProfileMeasurement measured = measure_profile(tree, camera, 1);
  EXPECT_EQ(measured.vertices, 2 * 64 * 64 * 10 / 8);
  EXPECT_GT(measured.fragments, 1000);
  EXPECT_GT(measured.vertices_s, 0.0);
  const ModelledFrame frame = model_frame(tree, camera, CostProfile{}, 1);
  EXPECT_GT(frame.predicted_s, 0.0);
  EXPECT_GT(frame.measured_s, 0.0);
}

TEST(ModelQuality, IsPerfectWhereEveryFrameTakesTwiceWhatWasForetold) {
  const ModelQuality twice = quality_of({{1, 2}, {2, 4}, {4, 8}, {8, 16}, {0, 1}});
  EXPECT_EQ(twice.lower, 0.5);
  EXPECT_EQ(twice.median, 0.5);
  EXPECT_EQ(twice.upper, 0.5);
  EXPECT_NEAR(twice.correlation, 1.0, 1e-12);
  EXPECT_NEAR(quality_of({{1, 8}, {2, 4}, {4, 2}, {8, 1}}).correlation, -1.0, 1e-12);
  // log 1, 2, 4 against log 1, 4, 2: (0, 1, 2) and (0, 2, 1) correlate by a half.
  EXPECT_NEAR(quality_of({{1, 1}, {2, 4}, {4, 2}}).correlation, 0.5, 1e-12);
  EXPECT_EQ(quality_of({{1, 1}}).median, 0.0);
}

}  // namespace
}  // namespace plumb::slicing
