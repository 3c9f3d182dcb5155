#include "golden_bits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/check.h"

namespace plumb::tool {
namespace {

using image::PlaneImage;

PlaneImage grey(int width, int height) {
  PlaneImage picture;
  picture.width_px = width;
  picture.height_px = height;
  for (const char* name : {"R", "Z", "N.X", "id", "lod"})
    picture.planes.push_back({name, std::vector<float>(picture.size(), 0.5f)});
  return picture;
}

float& at(PlaneImage& picture, const char* channel, std::size_t pixel) {
  for (image::Plane& plane : picture.planes) {
    if (plane.name == channel) return plane.values.at(pixel);
  }
  throw std::out_of_range(channel);
}

TEST(ChannelDifferences, CountPixelsByTheirBitsAndNameTheWorst) {
  const PlaneImage a = grey(4, 3);
  PlaneImage b = a;
  EXPECT_TRUE(channel_differences(a, b).empty());
  at(b, "Z", 2) = 0.75f;
  at(b, "Z", 6) = 1.5f;
  at(b, "Z", 7) = -0.5f;
  at(b, "N.X", 5) = std::numeric_limits<float>::infinity();
  const auto found = channel_differences(a, b);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].channel, "Z");
  EXPECT_EQ(found[0].pixels, 3);
  EXPECT_EQ(found[0].largest, 1.0);
  EXPECT_EQ(found[0].x, 2);  // the first of two that are 1 apart
  EXPECT_EQ(found[0].y, 1);
  EXPECT_EQ(found[0].picture, 1.5f);
  EXPECT_EQ(found[0].reference, 0.5f);
  EXPECT_EQ(found[1].channel, "N.X");
  EXPECT_TRUE(std::isinf(found[1].largest));
  EXPECT_EQ(text_of(found),
            "  Z: 3 pixels, 1 at most, at (2, 1): 1.5, golden 0.5\n"
            "  N.X: 1 pixels, inf at most, at (1, 1): inf, golden 0.5\n");
}

// A number and the next one are told apart in words, too.
TEST(ChannelDifferences, ShowEveryDigitOfALastBit) {
  const PlaneImage a = grey(1, 1);
  PlaneImage b = a;
  at(b, "R", 0) = std::nextafter(0.5f, 1.0f);
  EXPECT_EQ(text_of(channel_differences(a, b)),
            "  R: 1 pixels, 5.96046e-08 at most, at (0, 0): 0.50000006, golden 0.5\n");
}

TEST(ChannelDifferences, TellZeroFromMinusZeroAndNanFromItself) {
  PlaneImage a = grey(1, 1), b = a;
  at(a, "R", 0) = 0.0f;
  at(b, "R", 0) = -0.0f;
  at(a, "Z", 0) = at(b, "Z", 0) = std::numeric_limits<float>::quiet_NaN();
  const auto found = channel_differences(a, b);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].channel, "R");
  EXPECT_EQ(found[0].largest, 0.0);
  EXPECT_EQ(found[0].x, 0);
}

TEST(ChannelDifferences, CountAChannelOfOnePictureAloneWhole) {
  const PlaneImage a = grey(4, 3);
  PlaneImage b = a;
  b.planes.pop_back();
  for (const auto& found : {channel_differences(a, b), channel_differences(b, a)}) {
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].channel, "lod");
    EXPECT_EQ(found[0].pixels, 12);
    EXPECT_EQ(found[0].x, -1);
    EXPECT_EQ(text_of(found), "  lod: 12 pixels, in one picture alone\n");
  }
  EXPECT_THROW(channel_differences(a, grey(3, 4)), std::invalid_argument);
}

TEST(Patches, AreReadFromTheirChannels) {
  PlaneImage picture = grey(2, 1);
  at(picture, "id", 1) = 7.0f;
  at(picture, "lod", 1) = 2.0f;
  EXPECT_EQ(text_of(patch_at(picture, 1, 0)), "7, lod 2");
  picture.planes.pop_back();
  EXPECT_EQ(text_of(patch_at(picture, 1, 0)), "7");
  at(picture, "id", 0) = -1.0f;
  EXPECT_EQ(text_of(patch_at(picture, 0, 0)), "none");
  picture.planes.pop_back();
  EXPECT_EQ(text_of(patch_at(picture, 1, 0)), "-");
}

// Three pixels differ: two in patch 4, one in patch 9.
TEST(Patches, AreBlamedForMostOfThePixels) {
  PlaneImage a = grey(4, 1);
  for (std::size_t k = 0; k < 4; ++k) at(a, "id", k) = k == 0 ? 9.0f : 4.0f;
  PlaneImage b = a;
  EXPECT_FALSE(patch_responsible(a, b));
  at(b, "Z", 0) = at(b, "Z", 1) = at(b, "R", 3) = 2.0f;
  const auto share = patch_responsible(a, b);
  ASSERT_TRUE(share);
  EXPECT_EQ(share->patch, (PatchAt{4.0f, 0.5f}));
  EXPECT_TRUE(share->is_now);
  EXPECT_EQ(share->pixels, 2);
  EXPECT_EQ(share->of, 3);
  // A patch may have more than one level: three pixels of patch 4, on levels 1, 1 and 3.
  at(a, "lod", 1) = at(b, "lod", 1) = at(a, "lod", 3) = at(b, "lod", 3) = 1.0f;
  at(a, "lod", 2) = at(b, "lod", 2) = 3.0f;
  at(b, "Z", 2) = 2.0f;
  EXPECT_EQ(patch_responsible(a, b)->patch, (PatchAt{4.0f, 1.0f}));
  EXPECT_EQ(patch_responsible(a, b)->pixels, 2);
}

// A hole: the patch that should have been there is named.
TEST(Patches, OfTheReferenceAreBlamedWhereNoneIsLeft) {
  PlaneImage a = grey(2, 1), b = a;
  at(a, "id", 1) = 6.0f;
  at(b, "id", 1) = -1.0f;
  const auto share = patch_responsible(a, b);
  ASSERT_TRUE(share);
  EXPECT_EQ(share->patch.id, 6.0f);
  EXPECT_FALSE(share->is_now);
  for (PlaneImage* picture : {&a, &b}) picture->planes.resize(3);
  at(b, "Z", 0) = 1.0f;
  EXPECT_FALSE(patch_responsible(a, b));
}

}  // namespace
}  // namespace plumb::tool
