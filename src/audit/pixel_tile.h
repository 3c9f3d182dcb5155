// A few pixels side by side: what they show mostly lies close together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/hit_image.h"
#include "core/parallel.h"

namespace plumb::audit {

struct PixelTile {
  static constexpr int kWidth = 8, kHeight = 2;
  static constexpr std::size_t kPixels = kWidth * kHeight;

  const HitImage& image;
  int x0, y0;

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int y = y0; y < std::min(y0 + kHeight, image.height_px); ++y) {
      for (int x = x0; x < std::min(x0 + kWidth, image.width_px); ++x) visit(image.index(x, y));
    }
  }
};

/// Calls visit(tile) for every tile of a picture, in any order and on any thread.
template <class Visit>
void for_each_tile(const HitImage& image, const Visit& visit) {
  constexpr int kHeight = PixelTile::kHeight;
  parallel_for((image.height_px + kHeight - 1) / kHeight, 1, [&](std::int64_t row) {
    for (int x = 0; x < image.width_px; x += PixelTile::kWidth)
      visit(PixelTile{image, x, static_cast<int>(row) * kHeight});
  });
}

}  // namespace plumb::audit
