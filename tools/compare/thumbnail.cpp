#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "compare/comparison_pictures.h"
#include "compare/display_pictures.h"
#include "image/image_files.h"
#include "report/heat_map.h"

namespace plumb::compare {
namespace {

constexpr int kWidestPx = 126, kHighestPx = 192;  // of one of the two pictures
constexpr int kGapPx = 4;

// Where the scale of colours or FLIP ends, so that rows compare: noise is dark beside a defect.
constexpr double kStrong = 0.25;

struct Size {
  int width_px = 1, height_px = 1;
};

Size small_size(int width_px, int height_px) {
  const double shrink = std::max({1.0, static_cast<double>(width_px) / kWidestPx,
                                  static_cast<double>(height_px) / kHighestPx});
  return {std::max(1, static_cast<int>(width_px / shrink)),
          std::max(1, static_cast<int>(height_px / shrink))};
}

// Calls visit(small pixel, large pixel) for every pixel of the large picture once, in its order.
template <class Visit>
void for_each_pixel(const Size& large, const Size& small, const Visit& visit) {
  const auto place = [](int at, int from, int to) {
    return static_cast<std::size_t>(static_cast<std::int64_t>(at) * to / from);
  };
  std::size_t k = 0;
  for (int y = 0; y < large.height_px; ++y) {
    const std::size_t row = place(y, large.height_px, small.height_px) * small.width_px;
    for (int x = 0; x < large.width_px; ++x, ++k)
      visit(row + place(x, large.width_px, small.width_px), k);
  }
}

image::Rgb8Image mean_of(const image::Rgb8Image& picture, const Size& size) {
  const std::size_t pixels = static_cast<std::size_t>(size.width_px) * size.height_px;
  std::vector<std::int64_t> sums(3 * pixels, 0), counts(pixels, 0);
  for_each_pixel({picture.width_px, picture.height_px}, size,
                 [&](std::size_t to, std::size_t from) {
                   for (std::size_t c = 0; c < 3; ++c)
                     sums[3 * to + c] += picture.rgb[3 * from + c];
                   ++counts[to];
                 });
  image::Rgb8Image small{size.width_px, size.height_px, std::vector<std::uint8_t>(3 * pixels)};
  for (std::size_t k = 0; k < 3 * pixels; ++k)
    small.rgb[k] = static_cast<std::uint8_t>((sums[k] + counts[k / 3] / 2) / counts[k / 3]);
  return small;
}

std::vector<double> worst_of(const std::vector<float>& values, const Size& large,
                             const Size& size) {
  std::vector<double> worst(static_cast<std::size_t>(size.width_px) * size.height_px,
                            std::numeric_limits<double>::quiet_NaN());
  for_each_pixel(large, size, [&](std::size_t to, std::size_t from) {
    const double value{values[from]};
    if (!std::isnan(value) && !(worst[to] >= value)) worst[to] = value;
  });
  return worst;
}

bool any_over(const ErrorMap& map, double bound) {
  return std::any_of(map.values.begin(), map.values.end(),
                     [&](float value) { return double{value} > bound; });
}

// The first map that breaks its limit, else the first that has anything to show.
const ErrorMap* telling_map(const Comparison& comparison) {
  for (const ErrorMap& map : comparison.maps) {
    if (map.limit && any_over(map, *map.limit)) return &map;
  }
  for (const ErrorMap& map : comparison.maps) {
    if (any_over(map, 0.0)) return &map;
  }
  return comparison.maps.empty() ? nullptr : &comparison.maps.front();
}

image::Rgb8Image side_by_side(const image::Rgb8Image& left, const image::Rgb8Image& right) {
  const int width = left.width_px + kGapPx + right.width_px;
  image::Rgb8Image both{width, left.height_px, {}};
  both.rgb.assign(static_cast<std::size_t>(3 * width) * static_cast<std::size_t>(left.height_px),
                  250);
  for (int y = 0; y < left.height_px; ++y) {
    const auto begin = both.rgb.begin() + std::ptrdiff_t{3} * width * y;
    std::copy_n(left.rgb.begin() + std::ptrdiff_t{3} * left.width_px * y, 3 * left.width_px, begin);
    std::copy_n(right.rgb.begin() + std::ptrdiff_t{3} * right.width_px * y, 3 * right.width_px,
                begin + 3 * (left.width_px + kGapPx));
  }
  return both;
}

}  // namespace

std::vector<std::uint8_t> thumbnail_png(const PicturePair& pair, const Comparison& comparison) {
  const Size large{pair.width_px(), pair.height_px()};
  const Size size = small_size(large.width_px, large.height_px);
  image::Rgb8Image small = mean_of(display_pair(pair).candidate, size);
  if (const ErrorMap* map = telling_map(comparison)) {
    report::HeatMapOptions options;
    options.limit = map->limit;
    if (!map->limit && map->unit.empty()) options.high = kStrong;
    report::RgbImage heat = report::heat_picture(size.width_px, size.height_px,
                                                 worst_of(map->values, large, size), options);
    small = side_by_side(small, {heat.width, heat.height, std::move(heat.rgb)});
  }
  const std::string bytes = image::png_bytes(small);
  return {bytes.begin(), bytes.end()};
}

}  // namespace plumb::compare
