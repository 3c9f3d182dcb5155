#include "compare/others_bilinear.h"

#include <algorithm>
#include <cstdlib>

#include "compare/others_rules.h"
#include "core/check.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

using image::Rgb8Image;

constexpr int kSubpixelBits = 8, kPixel = 1 << kSubpixelBits;

// Where the suites look between the 3 x 3 pixels, in 1/256 of a pixel from the upper left one.
constexpr int kPlaces[28][2] = {
    {226, 186}, {335, 235}, {279, 334}, {178, 272}, {112, 202}, {306, 117}, {396, 299},
    {206, 382}, {146, 96},  {423, 155}, {361, 412}, {84, 339},  {48, 130},  {367, 43},
    {455, 367}, {105, 439}, {83, 46},   {217, 24},  {461, 71},  {450, 459}, {239, 469},
    {67, 267},  {459, 255}, {13, 416},  {10, 192},  {141, 502}, {503, 304}, {380, 506}};

const std::uint8_t* at(const Rgb8Image& picture, int x, int y) {
  return &picture
              .rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                        static_cast<std::size_t>(x))];
}

bool alike(const std::uint8_t* colour, const std::uint8_t* other, int tolerance) {
  for (int c = 0; c < 3; ++c) {
    if (std::abs(colour[c] - other[c]) > tolerance) return false;
  }
  return true;
}

// (u, v) in 1/256 of a pixel, pixels at whole numbers, left and above the last ones.
bool alike_between(const std::uint8_t* colour, const Rgb8Image& picture, int u, int v,
                   int tolerance) {
  const int x = u >> kSubpixelBits, y = v >> kSubpixelBits;
  const int right = u - x * kPixel, down = v - y * kPixel;
  const std::uint8_t *above = at(picture, x, y), *below = at(picture, x, y + 1);
  for (int c = 0; c < 3; ++c) {
    const int sum = (kPixel - down) * ((kPixel - right) * above[c] + right * above[c + 3]) +
                    down * ((kPixel - right) * below[c] + right * below[c + 3]);
    const int value = (sum + kPixel * kPixel / 2) >> (2 * kSubpixelBits);
    if (std::abs(colour[c] - value) > tolerance) return false;
  }
  return true;
}

bool has_like(const Rgb8Image& picture, const std::uint8_t* colour, int x, int y, int tolerance) {
  if (alike(colour, at(picture, x, y), tolerance)) return true;
  const int last_x = picture.width_px - 1, last_y = picture.height_px - 1;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, last_y); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, last_x); ++i) {
      if (alike(colour, at(picture, i, j), tolerance)) return true;
    }
  }
  for (const auto& place : kPlaces) {
    const int u = (x - 1) * kPixel + place[0], v = (y - 1) * kPixel + place[1];
    if (u < 0 || v < 0 || u >= last_x * kPixel || v >= last_y * kPixel) continue;
    if (alike_between(colour, picture, u, v, tolerance)) return true;
  }
  return false;
}

}  // namespace

std::int64_t bilinear_mismatches(const Rgb8Image& reference, const Rgb8Image& candidate,
                                 int tolerance) {
  require_judgeable(reference, candidate);
  require(tolerance >= 0 && tolerance <= 255, "tolerance must be in [0, 255], got {}", tolerance);
  return parallel_ordered_reduce(
      reference.height_px, 16, std::int64_t{0},
      [&](std::int64_t begin, std::int64_t end, std::int64_t count) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
          for (int x = 0; x < reference.width_px; ++x) {
            if (!has_like(reference, at(candidate, x, y), x, y, tolerance) &&
                !has_like(candidate, at(reference, x, y), x, y, tolerance))
              ++count;
          }
        }
        return count;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
}

}  // namespace plumb::compare
