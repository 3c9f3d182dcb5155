#include "compare/comparison_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "compare/display_pictures.h"
#include "image/image_files.h"
#include "report/heat_map.h"
#include "report/heat_scale.h"
#include "small_comparisons.h"
#include "support/run_command.h"

#include <fstream>

namespace plumb::compare {
namespace {

using Code = std::array<int, 3>;

Code at(const image::Rgb8Image& picture, int x, int y) {
  const std::size_t k =
      3 * (static_cast<std::size_t>(y) * picture.width_px + static_cast<std::size_t>(x));
  return {picture.rgb[k], picture.rgb[k + 1], picture.rgb[k + 2]};
}

Code code(report::Rgb colour) { return {colour.r, colour.g, colour.b}; }

// One row of pixels of one grey channel set.
PicturePair row_pair(std::vector<float> reference, std::vector<float> candidate,
                     image::Encoding encoding) {
  PicturePair pair;
  for (auto [picture, values] :
       {std::pair{&pair.reference, &reference}, std::pair{&pair.candidate, &candidate}}) {
    picture->width_px = static_cast<int>(values->size());
    picture->height_px = 1;
    picture->encoding = encoding;
    picture->planes = {{"Y", *values}};
  }
  return pair;
}

// A linear half is 188 as sRGB; what lies above one is white, what is no number black.
TEST(DisplayPictures, EncodeLinearLightAndClampIt) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PicturePair pair =
      row_pair({0.5f, 7.0f, -1.0f, nan}, {0.0f, 1.0f, 0.0f, 1.0f}, image::Encoding::Linear);
  const image::Rgb8Image shown = display_pair(pair).reference;
  EXPECT_EQ(at(shown, 0, 0), (Code{188, 188, 188}));
  EXPECT_EQ(at(shown, 1, 0), (Code{255, 255, 255}));
  EXPECT_EQ(at(shown, 2, 0), (Code{0, 0, 0}));
  EXPECT_EQ(at(shown, 3, 0), (Code{0, 0, 0}));
}

TEST(DisplayPictures, ShowStoredColoursAsTheyAre) {
  const PicturePair pair =
      row_pair({0.0f, 100.0f / 255.0f, 1.0f}, {0.0f, 0.0f, 0.0f}, image::Encoding::Srgb);
  const DisplayPair shown = display_pair(pair);
  EXPECT_EQ(at(shown.reference, 1, 0), (Code{100, 100, 100}));
  EXPECT_EQ(shown.note, "Colours as stored.");
  EXPECT_TRUE(shown.legend.rgb.empty());
}

// Depths of 1 to 3 on one scale for both: 1 is its dark end and 3 its light one; sky is infinite.
TEST(DisplayPictures, ShowDepthAsAHeatMapOnOneScale) {
  PicturePair pair = row_pair({1.0f, 2.0f, std::numeric_limits<float>::infinity()},
                              {3.0f, 1.0f, 1.0f}, image::Encoding::Linear);
  pair.reference.planes[0].name = pair.candidate.planes[0].name = "Z";
  const DisplayPair shown = display_pair(pair);
  EXPECT_EQ(at(shown.reference, 0, 0), code(report::scale_colour(0.0)));
  EXPECT_EQ(at(shown.reference, 1, 0), code(report::scale_colour(0.5)));
  EXPECT_EQ(at(shown.candidate, 0, 0), code(report::scale_colour(1.0)));
  EXPECT_EQ(at(shown.reference, 2, 0), (Code{196, 204, 214}));
  EXPECT_EQ(shown.legend.width_px, report::kPageLegendWidthPx);
}

TEST(DisplayPictures, ShowAnyOtherChannelInGreysBetweenItsExtremes) {
  PicturePair pair = row_pair({-1.0f, 0.0f}, {1.0f, 0.0f}, image::Encoding::Linear);
  pair.reference.planes[0].name = pair.candidate.planes[0].name = "N.X";
  const DisplayPair shown = display_pair(pair);
  EXPECT_EQ(at(shown.reference, 0, 0), (Code{0, 0, 0}));
  EXPECT_EQ(at(shown.reference, 1, 0), (Code{128, 128, 128}));
  EXPECT_EQ(at(shown.candidate, 0, 0), (Code{255, 255, 255}));
  EXPECT_EQ(shown.note, "Channel N.X: black is -1, white 1.");
}

// The largest difference is 0.1: eight times that is still below one. 128.5 + 127 * 0.8 = 230.1.
TEST(DisplayPictures, TheDifferenceHasASignAndAGain) {
  const PicturePair pair = row_pair({0.5f, 0.5f, 0.5f}, {0.5f, 0.6f, 0.4f}, image::Encoding::Srgb);
  const DifferencePicture difference = difference_picture(pair);
  EXPECT_EQ(difference.gain, 8.0);
  EXPECT_EQ(at(difference.picture, 0, 0), (Code{128, 128, 128}));
  EXPECT_EQ(at(difference.picture, 1, 0), (Code{230, 230, 230}));
  EXPECT_EQ(at(difference.picture, 2, 0), (Code{26, 26, 26}));
}

TEST(DisplayPictures, TheDifferenceLeavesOutWhatTheMaskDoes) {
  PicturePair pair = row_pair({0.5f, 0.5f}, {1.0f, 0.51f}, image::Encoding::Srgb);
  pair.mask = {0, 1};
  const DifferencePicture difference = difference_picture(pair);
  EXPECT_EQ(difference.gain, 64.0);  // of the difference that is judged alone
  EXPECT_EQ(at(difference.picture, 0, 0), (Code{0, 0, 0}));
}

TEST(DisplayPictures, RefusePicturesWithoutAChannel) {
  EXPECT_THROW(display_pair(PicturePair{}), std::invalid_argument);
}

TEST(ComparisonPictures, AreReferenceCandidateDifferenceAndMaps) {
  PicturePair pair = testing::cracked_pair();
  Comparison c = testing::cracked_comparison(pair);
  c.maps.push_back(c.maps[0]);
  c.maps.back().name = "Colour -- difference!";
  pair.mask.assign(pair.size(), 1);
  std::vector<std::string> files;
  for (const ReportPicture& picture : comparison_pictures(pair, c)) files.push_back(picture.file);
  EXPECT_EQ(files, (std::vector<std::string>{"reference.png", "candidate.png", "difference.png",
                                             "colour-difference.png", "colour-difference-2.png",
                                             "coverage.png", "mask.png"}));
}

// The crack's 0.43 and more is over the map's limit of 0.1.
TEST(ComparisonPictures, AMapHasAColourForWhatIsOverItsLimit) {
  const PicturePair pair = testing::cracked_pair();
  const auto pictures = comparison_pictures(pair, testing::cracked_comparison(pair));
  EXPECT_EQ(at(pictures[3].picture, 20, 8), code(report::kOverLimitColour));
  EXPECT_EQ(at(pictures[3].picture, 10, 8), code(report::scale_colour(0.0)));
  EXPECT_EQ(pictures[3].legend.width_px, report::kPageLegendWidthPx);
}

TEST(ComparisonPictures, RefuseAMapOfAnotherSize) {
  const PicturePair pair = testing::cracked_pair();
  Comparison c = testing::cracked_comparison(pair);
  c.maps[0].values.pop_back();
  EXPECT_THROW(comparison_pictures(pair, c), std::invalid_argument);
}

TEST(ComparisonPictures, ShowHolesAndOvershoot) {
  PicturePair pair = testing::cracked_pair();
  pair.candidate.planes[3].values[5] = 100.0f;  // terrain in the sky of row 0
  const Comparison c = testing::cracked_comparison(pair);
  const image::Rgb8Image picture = coverage_picture(pair, *c.coverage);
  EXPECT_EQ(at(picture, 20, 8), (Code{230, 30, 30}));
  EXPECT_EQ(at(picture, 5, 0), (Code{220, 40, 220}));
  EXPECT_EQ(at(picture, 2, 12), (Code{60, 60, 60}));
  EXPECT_EQ(at(picture, 30, 0), (Code{225, 225, 225}));
}

TEST(ComparisonPictures, StripeWhatTheMaskLeavesOut) {
  PicturePair pair = testing::cracked_pair();
  pair.mask.assign(pair.size(), 1);
  const image::Rgb8Image candidate = display_pair(pair).candidate;
  EXPECT_EQ(mask_picture(pair, candidate), candidate);
  pair.mask[0] = 0;
  const image::Rgb8Image striped = mask_picture(pair, candidate);
  EXPECT_EQ(at(striped, 0, 0), (Code{255, 200, 0}));
  EXPECT_EQ(at(striped, 1, 0), at(candidate, 1, 0));
}

TEST(ComparisonPictures, StackPictureAndLegend) {
  const image::Rgb8Image above{1, 1, {1, 2, 3}}, below{2, 1, {4, 5, 6, 7, 8, 9}};
  EXPECT_EQ(stacked(above, below),
            (image::Rgb8Image{2, 2, {1, 2, 3, 250, 250, 250, 4, 5, 6, 7, 8, 9}}));
  EXPECT_EQ(stacked(above, {}), above);
}

// A picture of 1280 x 640 becomes 126 x 63, twice. The crack of one pixel, a tenth of a small one,
// is still as red there as anything: column 800 of 1280 is column 78 of 126.
TEST(Thumbnail, KeepsACrackOfOnePixel) {
  const PicturePair pair = testing::cracked_pair(1280, 640, 800);
  const std::vector<std::uint8_t> png = thumbnail_png(pair, testing::cracked_comparison(pair));
  const plumb::testing::TemporaryFolder folder;
  std::ofstream(folder.file("t.png"), std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  const image::Rgb8Image small = image::read_png(folder.file("t.png"));
  EXPECT_EQ(small.width_px, 256);
  EXPECT_EQ(small.height_px, 63);
  EXPECT_EQ(at(small, 126 + 4 + 78, 32), code(report::kOverLimitColour));
  EXPECT_EQ(at(small, 126 + 4 + 80, 32), code(report::scale_colour(0.0)));
}

TEST(Thumbnail, OfASmallPictureKeepsItsSize) {
  const PicturePair pair = testing::cracked_pair();
  Comparison c = testing::cracked_comparison(pair);
  c.maps.clear();
  const std::vector<std::uint8_t> png = thumbnail_png(pair, c);
  EXPECT_EQ(png[19], 32);  // width and height, the last bytes of each
  EXPECT_EQ(png[23], 16);
}

}  // namespace
}  // namespace plumb::compare
