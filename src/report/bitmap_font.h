// A tiny font of dots, for legends in pictures.
#pragma once

#include <string_view>

#include "report/rgb_image.h"

namespace plumb::report {

inline constexpr int kGlyphColumns = 5;    // dots
inline constexpr int kGlyphRows = 7;       // dots; letters stand on the lowest row
inline constexpr int kGlyphAdvance = 6;    // from one letter to the next, dots
inline constexpr int kTextLineHeight = 9;  // from one line to the next, dots

/// True if the glyph of `letter` has a dot at (column, row), row 0 on top. Printable ASCII;
/// anything else is an open box. Throws std::invalid_argument if the place lies outside the glyph.
bool glyph_dot(char letter, int column, int row);

/// Width of a line of text, pixels; `scale` >= 1 pixels a dot. The last letter ends without a gap.
int text_width_px(std::string_view text, int scale = 1);

/// Writes one line with its top left corner at (x, y); what falls outside the picture is left out.
/// A byte is a letter. Throws std::invalid_argument if scale < 1.
void draw_text(RgbImage& image, int x, int y, std::string_view text, Rgb colour, int scale = 1);

}  // namespace plumb::report
