#include "compare/defect_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "audit/audit_pictures.h"
#include "compare/display_pictures.h"
#include "report/bitmap_font.h"
#include "report/heat_map.h"

namespace plumb::compare {
namespace {

constexpr int kWidth_px = 72, kHeight_px = 45;  // of a clipping, before it is enlarged
constexpr int kEnlarged = 3;
constexpr int kGap_px = 4;
constexpr int kTextScale = 2;
constexpr int kTitle_px = kTextScale * report::kTextLineHeight + kGap_px;
constexpr report::Rgb kPaper{250, 250, 250}, kInk{30, 30, 30};

// Left or top end of a clipping around `at` that lies inside, if the picture is large enough.
int begin_around(int at, int length, int whole) {
  return std::clamp(at - length / 2, 0, std::max(0, whole - length));
}

struct Clip {
  int x, y, columns, rows;
};

Clip clip_around(const Comparison& comparison) {
  int x = comparison.width_px / 2, y = comparison.height_px / 2;
  if (!comparison.worst.empty()) {
    x = comparison.worst.front().x;
    y = comparison.worst.front().y;
  }
  return {begin_around(x, kWidth_px, comparison.width_px),
          begin_around(y, kHeight_px, comparison.height_px),
          std::min(kWidth_px, comparison.width_px), std::min(kHeight_px, comparison.height_px)};
}

// Each pixel of picture(column, row) of the clipping becomes a square.
template <class Pixel>
image::Rgb8Image enlarged(const Clip& clip, const Pixel& pixel) {
  report::RgbImage large(kWidth_px * kEnlarged, kHeight_px * kEnlarged, kPaper);
  for (int y = 0; y < clip.rows; ++y) {
    for (int x = 0; x < clip.columns; ++x)
      large.fill(x * kEnlarged, y * kEnlarged, kEnlarged, kEnlarged, pixel(x, y));
  }
  return audit::rgb8_of(std::move(large));
}

image::Rgb8Image clipping_of(const image::Rgb8Image& picture, const Clip& clip) {
  return enlarged(clip, [&](int x, int y) {
    const std::uint8_t* at =
        &picture.rgb[3 * (static_cast<std::size_t>(clip.y + y) * picture.width_px +
                          static_cast<std::size_t>(clip.x + x))];
    return report::Rgb{at[0], at[1], at[2]};
  });
}

image::Rgb8Image heat_of(const Comparison& comparison, const std::string& name, double high,
                         const Clip& clip) {
  std::vector<double> values;
  for (const ErrorMap& map : comparison.maps) {
    if (map.name.find(name) == std::string::npos || !values.empty()) continue;
    for (int y = 0; y < clip.rows; ++y) {
      for (int x = 0; x < clip.columns; ++x)
        values.emplace_back(map.values[static_cast<std::size_t>(clip.y + y) *
                                           static_cast<std::size_t>(comparison.width_px) +
                                       static_cast<std::size_t>(clip.x + x)]);
    }
  }
  if (values.empty()) return enlarged({0, 0, 0, 0}, [](int, int) { return kPaper; });
  const report::RgbImage heat =
      report::heat_picture(clip.columns, clip.rows, values, {.high = high});
  return enlarged(clip, [&](int x, int y) { return heat.at(x, y); });
}

void put(const image::Rgb8Image& part, int left, int top, report::RgbImage& sheet) {
  for (int y = 0; y < part.height_px; ++y) {
    for (int x = 0; x < part.width_px; ++x) {
      const std::uint8_t* at = &part.rgb[3 * (static_cast<std::size_t>(y) * part.width_px +
                                              static_cast<std::size_t>(x))];
      sheet.set(left + x, top + y, {at[0], at[1], at[2]});
    }
  }
}

}  // namespace

SheetRow sheet_row(std::string title, const PicturePair& pair, const Comparison& comparison) {
  const DisplayPair shown = display_pair(pair);
  const Clip clip = clip_around(comparison);
  return {
      std::move(title),
      {clipping_of(shown.reference, clip), clipping_of(shown.candidate, clip),
       heat_of(comparison, "FLIP", 0.5, clip), heat_of(comparison, "isolated", 64.0 / 255.0, clip),
       heat_of(comparison, "unexplained", 32.0 / 255.0, clip)}};
}

image::Rgb8Image sheet_of(const std::vector<SheetRow>& rows) {
  constexpr int kColumn_px = kWidth_px * kEnlarged + kGap_px;
  constexpr int kRow_px = kTitle_px + kHeight_px * kEnlarged + kGap_px;
  const int columns = static_cast<int>(std::size(kSheetColumns));
  report::RgbImage sheet(kGap_px + columns * kColumn_px,
                         kTitle_px + static_cast<int>(rows.size()) * kRow_px, kPaper);
  for (int c = 0; c < columns; ++c)
    report::draw_text(sheet, kGap_px + c * kColumn_px, kGap_px, kSheetColumns[c], kInk, 1);
  int top = kTitle_px;
  for (const SheetRow& row : rows) {
    report::draw_text(sheet, kGap_px, top, row.title, kInk, kTextScale);
    for (std::size_t c = 0; c < row.clippings.size(); ++c)
      put(row.clippings[c], kGap_px + static_cast<int>(c) * kColumn_px, top + kTitle_px, sheet);
    top += kRow_px;
  }
  return audit::rgb8_of(std::move(sheet));
}

}  // namespace plumb::compare
