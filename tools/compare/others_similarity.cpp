#include "compare/others_similarity.h"

#include <array>
#include <cstdint>
#include <vector>

#include "compare/others_rules.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

using image::Rgb8Image;

constexpr int kWindow = 7, kPixels = kWindow * kWindow;
constexpr double kC1 = (0.01 * 255.0) * (0.01 * 255.0), kC2 = (0.03 * 255.0) * (0.03 * 255.0);

// Sums over pixels of a channel of both pictures: x, y, x^2, y^2, x y. Whole numbers, so exact: at
// most 49 * 255^2.
constexpr int kSums = 5;
using Sums = std::array<std::int32_t, kSums>;

void add(Sums& sums, std::int32_t x, std::int32_t y) {
  sums[0] += x;
  sums[1] += y;
  sums[2] += x * x;
  sums[3] += y * y;
  sums[4] += x * y;
}

double similarity(const Sums& s) {
  const double x = static_cast<double>(s[0]) / kPixels, y = static_cast<double>(s[1]) / kPixels;
  const auto variance = [](std::int64_t products, std::int64_t a, std::int64_t b) {
    return static_cast<double>(kPixels * products - a * b) / (kPixels * (kPixels - 1));
  };
  const double xx = variance(s[2], s[0], s[0]), yy = variance(s[3], s[1], s[1]),
               xy = variance(s[4], s[0], s[1]);
  return ((2.0 * x * y + kC1) * (2.0 * xy + kC2)) / ((x * x + y * y + kC1) * (xx + yy + kC2));
}

// Sum of the similarity of all windows whose first row is `top`, in one channel.
double row_of_windows(const Rgb8Image& reference, const Rgb8Image& candidate, int top, int channel,
                      std::vector<Sums>& columns) {
  const auto width = static_cast<std::size_t>(reference.width_px);
  columns.assign(width, Sums{});
  for (int y = top; y < top + kWindow; ++y) {
    std::size_t k = 3 * width * static_cast<std::size_t>(y) + static_cast<std::size_t>(channel);
    for (std::size_t x = 0; x < width; ++x, k += 3)
      add(columns[x], reference.rgb[k], candidate.rgb[k]);
  }
  Sums window{};
  double sum = 0.0;
  for (std::size_t x = 0; x < width; ++x) {
    for (int m = 0; m < kSums; ++m) {
      const auto k = static_cast<std::size_t>(m);
      window[k] += columns[x][k] - (x >= kWindow ? columns[x - kWindow][k] : 0);
    }
    if (x + 1 >= kWindow) sum += similarity(window);
  }
  return sum;
}

}  // namespace

double box_similarity(const Rgb8Image& reference, const Rgb8Image& candidate) {
  require_judgeable(reference, candidate);
  const int rows = reference.height_px - kWindow + 1, across = reference.width_px - kWindow + 1;
  std::vector<double> of_row(static_cast<std::size_t>(rows));
  parallel_for(rows, 8, [&](std::int64_t top) {
    std::vector<Sums> columns;
    double sum = 0.0;
    for (int channel = 0; channel < 3; ++channel)
      sum += row_of_windows(reference, candidate, static_cast<int>(top), channel, columns);
    of_row[static_cast<std::size_t>(top)] = sum;
  });
  double sum = 0.0;
  for (const double row : of_row) sum += row;
  return sum / (3.0 * rows * across);
}

}  // namespace plumb::compare
