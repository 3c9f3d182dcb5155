#include "compare/others_similarity.h"

#include <algorithm>
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

// Adds a row of a channel to each column's sums, or takes it away (sign -1).
void add_row(const Rgb8Image& reference, const Rgb8Image& candidate, int row, int channel,
             std::int32_t sign, std::vector<Sums>& columns) {
  std::size_t k = 3 * columns.size() * static_cast<std::size_t>(row);
  k += static_cast<std::size_t>(channel);
  for (Sums& sums : columns) {
    const std::int32_t x = reference.rgb[k], y = candidate.rgb[k];
    sums[0] += sign * x;
    sums[1] += sign * y;
    sums[2] += sign * (x * x);
    sums[3] += sign * (y * y);
    sums[4] += sign * (x * y);
    k += 3;
  }
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

// Sum of the similarity of all windows of a row of them, from the sums of their columns.
double along_row(const std::vector<Sums>& columns) {
  Sums window{};
  double sum = 0.0;
  for (std::size_t x = 0; x < columns.size(); ++x) {
    for (std::size_t m = 0; m < kSums; ++m)
      window[m] += columns[x][m] - (x >= kWindow ? columns[x - kWindow][m] : 0);
    if (x + 1 >= kWindow) sum += similarity(window);
  }
  return sum;
}

}  // namespace

double box_similarity(const Rgb8Image& reference, const Rgb8Image& candidate) {
  require_judgeable(reference, candidate);
  const int rows = reference.height_px - kWindow + 1, across = reference.width_px - kWindow + 1;
  std::vector<double> of_row(static_cast<std::size_t>(rows));
  constexpr int kBand = 16;  // rows of windows, each from the sums of the one above it
  parallel_for((rows + kBand - 1) / kBand, 1, [&](std::int64_t band) {
    const int first = static_cast<int>(band) * kBand, end = std::min(first + kBand, rows);
    std::vector<Sums> columns;
    for (int channel = 0; channel < 3; ++channel) {
      columns.assign(static_cast<std::size_t>(reference.width_px), Sums{});
      for (int y = first; y < first + kWindow - 1; ++y)
        add_row(reference, candidate, y, channel, 1, columns);
      for (int top = first; top < end; ++top) {
        add_row(reference, candidate, top + kWindow - 1, channel, 1, columns);
        of_row[static_cast<std::size_t>(top)] += along_row(columns);
        add_row(reference, candidate, top, channel, -1, columns);
      }
    }
  });
  double sum = 0.0;
  for (const double row : of_row) sum += row;
  return sum / (3.0 * rows * across);
}

}  // namespace plumb::compare
