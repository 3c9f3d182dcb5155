#include "compare/local_difference.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

struct Range {
  float low, high;

  // How far beyond it a number is.
  float beyond(float value) const { return std::max({0.0f, value - high, low - value}); }
  void take(float value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// A plane and what stands around its pixels; its rim is repeated beyond it.
class Neighbours {
 public:
  Neighbours(std::span<const float> plane, int width, int height)
      : plane_(plane), width_(width), height_(height) {}

  float at(int x, int y) const {
    const int column = std::clamp(x, 0, width_ - 1), row = std::clamp(y, 0, height_ - 1);
    return plane_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(column)];
  }

  // Largest less smallest of the 5 x 5 pixels.
  float contrast(int x, int y) const {
    Range range{at(x, y), at(x, y)};
    for (int j = -2; j <= 2; ++j) {
      for (int i = -2; i <= 2; ++i) range.take(at(x + i, y + j));
    }
    return range.high - range.low;
  }

  // Of the 3 x 3 pixels, and of the nine places a quarter of a pixel away in x and in y. (Between
  // them a bilinear surface has no larger and no smaller number.)
  void ranges(int x, int y, Range& around, Range& quarter) const {
    float cell[3][3];
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) cell[j][i] = at(x + i - 1, y + j - 1);
    }
    around = quarter = {cell[1][1], cell[1][1]};
    for (const auto& row : cell) {
      for (const float value : row) around.take(value);
    }
    for (int j = 0; j < 3; j += 2) {
      for (int i = 0; i < 3; i += 2) widen(cell, i, j, quarter);
    }
  }

 private:
  // Towards the corner (i, j) of the 3 x 3 pixels.
  static void widen(const float (&cell)[3][3], int i, int j, Range& quarter) {
    const float along_x = 0.75f * cell[1][1] + 0.25f * cell[1][i];
    const float along_y = 0.75f * cell[1][1] + 0.25f * cell[j][1];
    const float both = 0.75f * along_x + 0.25f * (0.75f * cell[j][1] + 0.25f * cell[j][i]);
    for (const float value : {along_x, along_y, both}) quarter.take(value);
  }

  std::span<const float> plane_;
  int width_, height_;
};

}  // namespace

LocalDifference local_difference(std::span<const std::span<const float>> reference,
                                 std::span<const std::span<const float>> candidate, int width_px,
                                 int height_px) {
  require(reference.size() == candidate.size() && width_px >= 1 && height_px >= 1,
          "two pictures must have the same channels and be at least 1 x 1 pixels");
  const auto size = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  const std::vector<float> nothing(size, 0.0f);
  LocalDifference result{nothing, nothing, nothing, nothing};
  for (std::size_t plane = 0; plane < reference.size(); ++plane) {
    require(reference[plane].size() == size && candidate[plane].size() == size,
            "every plane must have {} numbers", size);
    const Neighbours there(reference[plane], width_px, height_px);
    const Neighbours here(candidate[plane], width_px, height_px);
    parallel_for(height_px, 8, [&](std::int64_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < width_px; ++x) {
        const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) +
                           static_cast<std::size_t>(x);
        const float a = reference[plane][pixel], b = candidate[plane][pixel];
        if (a == b) continue;
        Range around_a, quarter_a, around_b, quarter_b;
        there.ranges(x, y, around_a, quarter_a);
        here.ranges(x, y, around_b, quarter_b);
        // Explained from either side is explained: a thin feature is wide in one of the two.
        const float unexplained = std::min(quarter_a.beyond(b), quarter_b.beyond(a));
        const float out_of_a = around_a.beyond(b), out_of_b = around_b.beyond(a);
        if (unexplained == 0.0f && out_of_a == 0.0f && out_of_b == 0.0f) continue;
        const float contrast_a = there.contrast(x, y), contrast_b = here.contrast(x, y);
        const auto raise = [&](std::vector<float>& values, float value) {
          values[pixel] = std::max(values[pixel], value);
        };
        raise(result.unexplained, unexplained);
        raise(result.out_of_range, std::max(out_of_a, out_of_b));
        raise(result.isolated, std::max(out_of_a - contrast_a, out_of_b - contrast_b));
        raise(result.contrast, std::max(contrast_a, contrast_b));
      }
    });
  }
  return result;
}

}  // namespace plumb::compare
