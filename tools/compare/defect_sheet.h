// One picture of what was planted and of what finds it, enlarged around the worst pixel.
#pragma once

#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/picture_pair.h"
#include "image/colour_image.h"

namespace plumb::compare {

/// A row of the sheet: a title and kSheetColumns clippings, enlarged.
struct SheetRow {
  std::string title;
  std::vector<image::Rgb8Image> clippings;
};

inline constexpr const char* kSheetColumns[] = {"reference", "candidate", "FLIP, to 0.5",
                                                "isolated, to 64/255", "unexplained, to 32/255"};

/// Around the pixel that is worst in what breaks a limit, or differs most. The comparison has its
/// maps and its worst pixels.
SheetRow sheet_row(std::string title, const PicturePair& pair, const Comparison& comparison);

/// The rows below each other, the columns' names on top.
image::Rgb8Image sheet_of(const std::vector<SheetRow>& rows);

}  // namespace plumb::compare
