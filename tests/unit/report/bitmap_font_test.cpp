#include "report/bitmap_font.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace plumb::report {
namespace {

constexpr Rgb kWhite{255, 255, 255};

std::string dots_of(char letter) {
  std::string dots;
  for (int row = 0; row < kGlyphRows; ++row) {
    for (int column = 0; column < kGlyphColumns; ++column)
      dots += glyph_dot(letter, column, row) ? '#' : '.';
  }
  return dots;
}

TEST(BitmapFont, DrawsAnLAsAStrokeAndAFoot) {
  EXPECT_EQ(dots_of('L'), "#....#....#....#....#....#....#####");
}

TEST(BitmapFont, GivesEveryPrintableLetterAShapeOfItsOwn) {
  std::set<std::string> shapes;
  for (char letter = ' '; letter <= '~'; ++letter) shapes.insert(dots_of(letter));
  EXPECT_EQ(shapes.size(), 95u);
}

TEST(BitmapFont, ShowsABoxForWhatItDoesNotKnow) {
  EXPECT_EQ(dots_of('\x07'), dots_of('\xe9'));
  EXPECT_TRUE(glyph_dot('\x07', 0, 0));
  EXPECT_FALSE(glyph_dot('\x07', 2, 3));
}

TEST(BitmapFont, MeasuresSixDotsALetterAndNoGapAtTheEnd) {
  EXPECT_EQ(text_width_px(""), 0);
  EXPECT_EQ(text_width_px("i"), 5);
  EXPECT_EQ(text_width_px("12"), 11);
  EXPECT_EQ(text_width_px("12", 3), 33);
}

TEST(BitmapFont, DrawsADotAsASquareOfTheScale) {
  RgbImage image(40, 20);
  draw_text(image, 2, 3, ".", kWhite, 2);  // dots (1..2, 5..6)
  int lit = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) lit += image.at(x, y) == kWhite;
  }
  EXPECT_EQ(lit, 16);
  EXPECT_EQ(image.at(2 + 2, 3 + 10), kWhite);
  EXPECT_EQ(image.at(2 + 5, 3 + 13), kWhite);
}

TEST(BitmapFont, LeavesOutWhatFallsOutsideThePicture) {
  RgbImage image(4, 4);
  draw_text(image, -3, -3, "###", kWhite, 1);
  draw_text(image, 100, 100, "#", kWhite, 1);
  EXPECT_EQ(image.rgb.size(), 48u);
}

TEST(BitmapFont, RefusesAScaleBelowOneAndPlacesOutsideTheGlyph) {
  RgbImage image(4, 4);
  EXPECT_THROW(draw_text(image, 0, 0, "a", kWhite, 0), std::invalid_argument);
  EXPECT_THROW(glyph_dot('a', kGlyphColumns, 0), std::invalid_argument);
  EXPECT_THROW(glyph_dot('a', 0, -1), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::report
