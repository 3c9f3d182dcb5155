#include "audit/neighbourhood.h"

#include <algorithm>
#include <span>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

// Both are plain enough for vectors.
void lower_to(std::span<double> nearest, std::span<const double> other) {
  for (std::size_t k = 0; k < other.size(); ++k)
    nearest[k] = other[k] < nearest[k] ? other[k] : nearest[k];
}

void raise_to(std::span<double> deepest, std::span<const double> other) {
  for (std::size_t k = 0; k < other.size(); ++k)
    deepest[k] = other[k] > deepest[k] ? other[k] : deepest[k];
}

}  // namespace

// Along rows first, then along columns: 2 (2 radius + 1) looks a pixel.
Neighbourhoods neighbourhoods(const HitImage& image, int radius) {
  const auto width = static_cast<std::size_t>(image.width_px);
  const auto row_of = [&](auto& values, int y) {
    return std::span(values).subspan(static_cast<std::size_t>(y) * width, width);
  };
  Neighbourhoods along_rows{image.depth_m, image.depth_m};
  parallel_for(image.height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    const std::span<const double> depth = row_of(image.depth_m, y);
    const std::span<double> nearest = row_of(along_rows.nearest, y),
                            deepest = row_of(along_rows.deepest, y);
    for (std::size_t ahead = 1; ahead < std::min<std::size_t>(width, radius + 1); ++ahead) {
      lower_to(nearest, depth.subspan(ahead));
      lower_to(nearest.subspan(ahead), depth.first(width - ahead));
      raise_to(deepest, depth.subspan(ahead));
      raise_to(deepest.subspan(ahead), depth.first(width - ahead));
    }
  });
  Neighbourhoods all = along_rows;
  parallel_for(image.height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int b = std::max(0, y - radius); b <= std::min(image.height_px - 1, y + radius); ++b) {
      lower_to(row_of(all.nearest, y), row_of(along_rows.nearest, b));
      raise_to(row_of(all.deepest, y), row_of(along_rows.deepest, b));
    }
  });
  return all;
}

}  // namespace plumb::audit
