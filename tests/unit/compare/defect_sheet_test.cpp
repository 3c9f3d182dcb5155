#include "compare/defect_sheet.h"

#include <gtest/gtest.h>

#include "compare/picture_pair.h"
#include "compare/profile.h"

namespace plumb::compare {
namespace {

PicturePair pair_with_pixel(int width, int height, int x, int y) {
  const auto size = static_cast<std::size_t>(width * height);
  image::PlaneImage plain;
  plain.width_px = width;
  plain.height_px = height;
  plain.encoding = image::Encoding::Srgb;
  plain.bits = 8;
  for (const char* name : {"R", "G", "B"})
    plain.planes.push_back({name, std::vector<float>(size, 0.2f), 24});
  PicturePair pair{"reference", "candidate", plain, plain, {}};
  for (image::Plane& plane : pair.candidate.planes)
    plane.values[static_cast<std::size_t>(y * width + x)] = 1.0f;
  return pair;
}

std::uint8_t red_at(const image::Rgb8Image& picture, int x, int y) {
  return picture.rgb[3 * static_cast<std::size_t>(y * picture.width_px + x)];
}

// A clipping is 72 x 45 pixels, each three wide, around the worst one or up to the picture's edge.
TEST(DefectSheet, ShowsTheWorstPixelEnlarged) {
  const PicturePair pair = pair_with_pixel(200, 100, 190, 50);
  const Comparison comparison = compare_pictures(pair, built_in_profiles().front());
  const SheetRow row = sheet_row("pinhole", pair, comparison);
  ASSERT_EQ(row.clippings.size(), std::size(kSheetColumns));
  const int x = 3 * (190 - (200 - 72)), y = 3 * (50 - (50 - 22));
  for (const int offset : {0, 2}) {
    EXPECT_EQ(red_at(row.clippings[0], x + offset, y + offset), 51);
    EXPECT_EQ(red_at(row.clippings[1], x + offset, y + offset), 255);
  }
  EXPECT_EQ(red_at(row.clippings[1], x - 1, y), 51);
  EXPECT_EQ(red_at(row.clippings[1], x + 3, y), 51);
  // In the heat maps it is as bright as the scale goes, beside nothing.
  for (const std::size_t map : {std::size_t{3}, std::size_t{4}})
    EXPECT_GT(red_at(row.clippings[map], x + 1, y + 1), red_at(row.clippings[map], x - 4, y) + 100);
}

TEST(DefectSheet, TakesPicturesSmallerThanAClipping) {
  const PicturePair pair = pair_with_pixel(5, 3, 4, 2);
  const Comparison comparison = compare_pictures(pair, built_in_profiles().front());
  const SheetRow row = sheet_row("tiny", pair, comparison);
  const image::Rgb8Image sheet = sheet_of({row, row});
  EXPECT_EQ(sheet.width_px, 4 + 5 * (3 * 72 + 4));
  EXPECT_EQ(sheet.rgb.size(), 3u * static_cast<std::size_t>(sheet.width_px * sheet.height_px));
}

}  // namespace
}  // namespace plumb::compare
