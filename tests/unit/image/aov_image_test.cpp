#include "image/aov_image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/camera_metadata.h"

namespace plumb::image {
namespace {

Camera odd_camera() {
  Camera camera = make_camera({.eye_m = {500000.1, 4500000.7, 1234.5},
                               .target_m = {500100.3, 4500900.2, 900.25},
                               .width_px = 2,
                               .height_px = 1});
  camera.centre_px.x += 0.125;
  return camera;
}

HitImage two_pixels() {
  HitImage hits(2, 1);
  hits.depth_m[1] = 4.0;
  hits.from_eye_m[1] = {1.0, 2.0, 3.0};
  hits.primitive[1] = 5;
  hits.overdraw = {0, 3};
  return hits;
}

TEST(MakeAov, PutsEachNumberIntoItsChannel) {
  const std::vector<glm::dvec3> normals(2, {0.0, 0.6, 0.8});
  const std::vector<int> ids{9, 16777216}, lods{9, 2};
  ColourImage colours(2, 1);
  colours.r[0] = 0.25f;
  const AovImage image = make_aov(two_pixels(), odd_camera(), {normals, ids, lods, &colours});
  EXPECT_EQ(image.z, (std::vector<float>{INFINITY, 4.0f}));
  EXPECT_EQ(image.px, (std::vector<float>{0.0f, 1.0f}));
  EXPECT_EQ(image.py, (std::vector<float>{0.0f, 2.0f}));
  EXPECT_EQ(image.pz, (std::vector<float>{0.0f, 3.0f}));
  EXPECT_EQ(image.ny, (std::vector<float>{0.0f, 0.6f}));
  EXPECT_EQ(image.nz, (std::vector<float>{0.0f, 0.8f}));
  EXPECT_EQ(image.id, (std::vector<float>{-1.0f, 16777216.0f}));
  EXPECT_EQ(image.lod, (std::vector<float>{-1.0f, 2.0f}));
  EXPECT_EQ(image.overdraw, (std::vector<float>{0.0f, 3.0f}));
  EXPECT_EQ(image.r, (std::vector<float>{0.25f, 0.0f}));
}

TEST(MakeAov, LeavesOutWhatIsNotKnown) {
  HitImage cast = two_pixels();
  cast.overdraw.clear();
  const AovImage image = make_aov(cast, odd_camera());
  EXPECT_EQ(image.z.size(), 2u);
  EXPECT_TRUE(image.r.empty() && image.nx.empty() && image.id.empty() && image.lod.empty() &&
              image.overdraw.empty());
}

TEST(MakeAov, RefusesShapesThatDifferAndIdsThatAFloatWouldRound) {
  const std::vector<int> three(3, 0), too_large{0, 16777217};
  Camera wide = odd_camera();
  wide.width_px = 3;
  EXPECT_THROW(make_aov(two_pixels(), wide), std::invalid_argument);
  EXPECT_THROW(make_aov(two_pixels(), odd_camera(), {.ids = three}), std::invalid_argument);
  EXPECT_THROW(make_aov(two_pixels(), odd_camera(), {.ids = too_large}), std::invalid_argument);
}

TEST(CameraMetadata, GivesTheCameraBackBitForBit) {
  const AovImage image = make_aov(two_pixels(), odd_camera());
  EXPECT_EQ(camera_of(image.metadata), odd_camera());
}

TEST(CameraMetadata, IsNothingWhereAPartIsMissing) {
  AovImage image = make_aov(two_pixels(), odd_camera());
  image.metadata.erase("camera.near");
  EXPECT_EQ(camera_of(image.metadata), std::nullopt);
}

TEST(RawChecksum, ChangesWithEveryChannelAndNotWithTheMetadata) {
  AovImage image;
  image.width_px = 2;
  image.height_px = 1;
  for (const Channel& channel : channels()) image.*channel.values = {1.0f, 2.0f};
  const std::uint64_t sum = raw_checksum(image);
  image.metadata["x"] = 1.0;
  EXPECT_EQ(raw_checksum(image), sum);
  for (const Channel& channel : channels()) {
    AovImage changed = image;
    (changed.*channel.values)[1] = std::nextafter(2.0f, 3.0f);
    EXPECT_NE(raw_checksum(changed), sum) << channel.name;
    (changed.*channel.values).clear();
    EXPECT_NE(raw_checksum(changed), sum) << channel.name;
  }
}

TEST(PatchPlanes, NamePatchAndLevelOfEachHit) {
  DrawnSurface surface;
  surface.patches = {{0, 5, 3, "a"}, {5, 5, 1, "b"}};
  const PatchPlanes planes = patch_planes(two_pixels(), surface);
  EXPECT_EQ(planes.ids, (std::vector<int>{-1, 1}));
  EXPECT_EQ(planes.lods, (std::vector<int>{-1, 1}));
}

}  // namespace
}  // namespace plumb::image
