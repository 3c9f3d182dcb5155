#include "compare/comparison_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "audit/audit_pictures.h"
#include "compare/display_pictures.h"
#include "core/check.h"
#include "core/parallel.h"
#include "report/heat_map.h"

namespace plumb::compare {
namespace {

image::Rgb8Image blank(int width_px, int height_px, std::uint8_t grey) {
  return {width_px, height_px,
          std::vector<std::uint8_t>(
              3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), grey)};
}

// "colour difference" as a file: "colour-difference.png"; another name if that one is taken.
std::string file_for(const std::string& name, std::set<std::string>& taken) {
  std::string base;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    const bool plain = letter < 0x80 && std::isalnum(letter) != 0;
    if (plain) base += static_cast<char>(std::tolower(letter));
    if (!plain && !base.empty() && base.back() != '-') base += '-';
  }
  while (!base.empty() && base.back() == '-') base.pop_back();
  if (base.empty()) base = "map";
  std::string file = base + ".png";
  for (int n = 2; !taken.insert(file).second; ++n) file = fmt::format("{}-{}.png", base, n);
  return file;
}

ReportPicture map_picture(const PicturePair& pair, const ErrorMap& map, std::string file) {
  require(map.values.size() == pair.size(), "the map '{}' needs {} values, got {}", map.name,
          pair.size(), map.values.size());
  const std::vector<double> values(map.values.begin(), map.values.end());
  report::HeatMapOptions options;
  options.title = map.name;
  options.unit = map.unit;
  options.limit = map.limit;
  options.text_scale = report::kPageLegendTextScale;
  return {std::move(file), map.name, map.meaning,
          audit::rgb8_of(report::heat_picture(pair.width_px(), pair.height_px(), values, options)),
          audit::rgb8_of(report::heat_legend(report::kPageLegendWidthPx, values, options))};
}

}  // namespace

bool is_kind_map(const ErrorMap& map) { return map.name == "coverage"; }

image::Rgb8Image coverage_picture(const PicturePair& pair, const CoverageErrors& errors) {
  const int width = pair.width_px();
  image::Rgb8Image picture = blank(width, pair.height_px(), 0);
  const auto rule = sky_rule(pair.reference, pair.candidate);
  require(rule.has_value(), "a picture without depth and alpha has no coverage{}", "");
  const std::vector<std::uint8_t> terrain = shown_terrain(pair.reference, *rule);
  for (std::size_t k = 0; k < terrain.size(); ++k)
    std::fill_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * k), 3,
                std::uint8_t{terrain[k] != 0 ? std::uint8_t{60} : std::uint8_t{225}});
  for (const std::size_t k : errors.wrong) {
    const int x = static_cast<int>(k % static_cast<std::size_t>(width));
    const int y = static_cast<int>(k / static_cast<std::size_t>(width));
    const report::Rgb colour =
        terrain[k] != 0 ? report::Rgb{230, 30, 30} : report::Rgb{220, 40, 220};
    for (int b = -1; b <= 1; ++b) {
      for (int a = -1; a <= 1; ++a) audit::paint(picture, x + a, y + b, colour);
    }
  }
  return picture;
}

image::Rgb8Image mask_picture(const PicturePair& pair, const image::Rgb8Image& candidate) {
  image::Rgb8Image picture = candidate;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const std::size_t k =
          static_cast<std::size_t>(y) * picture.width_px + static_cast<std::size_t>(x);
      if (pair.judged(k)) continue;
      audit::paint(picture, x, y,
                   (x + y) / 3 % 2 == 0 ? report::Rgb{255, 200, 0} : report::Rgb{40, 40, 40});
    }
  }
  return picture;
}

image::Rgb8Image stacked(const image::Rgb8Image& above, const image::Rgb8Image& below) {
  if (below.rgb.empty()) return above;
  image::Rgb8Image both =
      blank(std::max(above.width_px, below.width_px), above.height_px + below.height_px, 250);
  const auto put = [&](const image::Rgb8Image& part, int top) {
    for (int y = 0; y < part.height_px; ++y) {
      const auto row = part.rgb.begin() + std::ptrdiff_t{3} * part.width_px * y;
      std::copy_n(row, 3 * part.width_px,
                  both.rgb.begin() + std::ptrdiff_t{3} * both.width_px * (top + y));
    }
  };
  put(above, 0);
  put(below, above.height_px);
  return both;
}

std::vector<ReportPicture> comparison_pictures(const PicturePair& pair,
                                               const Comparison& comparison) {
  DisplayPair shown = display_pair(pair);
  DifferencePicture difference = difference_picture(pair);
  std::set<std::string> taken{"reference.png", "candidate.png", "difference.png", "coverage.png",
                              "mask.png"};
  std::vector<const ErrorMap*> sizes;
  std::vector<std::string> files;
  for (const ErrorMap& map : comparison.maps) {
    if (is_kind_map(map)) continue;
    sizes.push_back(&map);
    files.push_back(file_for(map.name, taken));
  }
  std::vector<ReportPicture> maps(sizes.size());
  parallel_for(static_cast<std::int64_t>(maps.size()), 1, [&](std::int64_t at) {
    const auto k = static_cast<std::size_t>(at);
    maps[k] = map_picture(pair, *sizes[k], files[k]);
  });
  const image::Rgb8Image& candidate = shown.candidate;
  std::vector<ReportPicture> extra;
  if (comparison.coverage)
    extra.push_back({"coverage.png", "coverage",
                     "The reference: dark is terrain, light is sky. Red: hole; magenta: overshoot.",
                     coverage_picture(pair, *comparison.coverage)});
  if (!pair.mask.empty())
    extra.push_back({"mask.png", "mask", "The candidate; where it is striped nothing is judged.",
                     mask_picture(pair, candidate)});
  std::vector<ReportPicture> all;
  all.push_back(
      {"reference.png", "reference", shown.note, std::move(shown.reference), shown.legend});
  all.push_back(
      {"candidate.png", "candidate", shown.note, std::move(shown.candidate), shown.legend});
  all.push_back(
      {"difference.png", "signed difference", difference.note, std::move(difference.picture)});
  std::move(maps.begin(), maps.end(), std::back_inserter(all));
  std::move(extra.begin(), extra.end(), std::back_inserter(all));
  return all;
}

}  // namespace plumb::compare
