#include "audit/neighbourhood.h"

#include <algorithm>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

Neighbourhood join(Neighbourhood a, Neighbourhood b) {
  return {std::min(a.nearest, b.nearest), std::max(a.deepest, b.deepest)};
}

}  // namespace

// Along rows first, then along columns: 2 (2 radius + 1) looks a pixel.
std::vector<Neighbourhood> neighbourhoods(const HitImage& image, int radius) {
  std::vector<Neighbourhood> along_rows(image.size()), all(image.size());
  parallel_for(image.height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width_px; ++x) {
      Neighbourhood n{kNoHit, 0.0};
      for (int a = std::max(0, x - radius); a <= std::min(image.width_px - 1, x + radius); ++a) {
        const double depth = image.depth_m[image.index(a, y)];
        n = join(n, {depth, depth});
      }
      along_rows[image.index(x, y)] = n;
    }
  });
  parallel_for(image.height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width_px; ++x) {
      Neighbourhood n{kNoHit, 0.0};
      for (int b = std::max(0, y - radius); b <= std::min(image.height_px - 1, y + radius); ++b) {
        n = join(n, along_rows[image.index(x, b)]);
      }
      all[image.index(x, y)] = n;
    }
  });
  return all;
}

}  // namespace plumb::audit
