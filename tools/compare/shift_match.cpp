#include "compare/shift_match.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

using Planes = std::span<const std::span<const float>>;

bool is_like(float a, float b, double tolerance) {
  if (a == b) return true;
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::abs(double{a} - double{b}) <= tolerance;
}

struct Search {
  Planes from, to;
  int width, height;
  ShiftMatchOptions options;

  bool is_like_at(std::size_t pixel, std::size_t other) const {
    for (std::size_t plane = 0; plane < from.size(); ++plane) {
      if (!is_like(from[plane][pixel], to[plane][other], options.tolerance)) return false;
    }
    return true;
  }

  bool finds(int x, int y) const {
    const auto at = [&](int column, int row) {
      return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(column);
    };
    const std::size_t pixel = at(x, y);
    if (is_like_at(pixel, pixel)) return true;
    const int r = options.radius_px;
    for (int row = std::max(0, y - r); row <= std::min(height - 1, y + r); ++row) {
      for (int column = std::max(0, x - r); column <= std::min(width - 1, x + r); ++column) {
        if (is_like_at(pixel, at(column, row))) return true;
      }
    }
    return false;
  }
};

}  // namespace

std::vector<std::uint8_t> unmatched_pixels(Planes reference, Planes candidate, int width_px,
                                           int height_px, const ShiftMatchOptions& options) {
  require(reference.size() == candidate.size() && width_px >= 1 && height_px >= 1,
          "two pictures must have the same channels and be at least 1 x 1 pixels");
  const auto size = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  for (std::size_t k = 0; k < reference.size(); ++k) {
    require(reference[k].size() == size && candidate[k].size() == size,
            "every plane must have {} numbers", size);
  }
  require(options.radius_px >= 0 && options.tolerance >= 0.0,
          "radius and tolerance must be >= 0, got {} and {}", options.radius_px, options.tolerance);
  const Search there{reference, candidate, width_px, height_px, options};
  const Search back{candidate, reference, width_px, height_px, options};
  std::vector<std::uint8_t> unmatched(size, 0);
  parallel_for(height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_px; ++x) {
      const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                         static_cast<std::size_t>(x);
      unmatched[pixel] = there.finds(x, y) && back.finds(x, y) ? 0 : 1;
    }
  });
  return unmatched;
}

}  // namespace plumb::compare
