#include "compare/structural_similarity.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

// Weights of `length` <= kWindow neighbours around the middle; their sum is one.
std::vector<double> gaussian(int length) {
  std::vector<double> weights(static_cast<std::size_t>(length));
  double sum = 0.0;
  for (int k = 0; k < length; ++k) {
    const double x = k - 0.5 * (length - 1);
    sum += weights[static_cast<std::size_t>(k)] =
        reproducible_exp(-x * x / (2.0 * kSigma * kSigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Weighted means in a window: of both pictures, their squares and their product.
constexpr int kMoments = 5;
using Moments = std::array<double, kMoments>;

// Sum of rows from[k][0 .. count) times weights[k]. Weights are the same from both ends, so pairs
// are added before they are weighted. Known is the number of weights where compilers know it, or 0.
template <std::size_t Known>
void weigh_known(const std::vector<double>& weights, const std::vector<const double*>& from,
                 std::size_t count, double* __restrict out) {
  const std::size_t taps = Known > 0 ? Known : weights.size();
  const double *weight = weights.data(), *const *row = from.data();
  for (std::size_t w = 0; w < count; ++w) {
    double sum = taps % 2 == 1 ? weight[taps / 2] * row[taps / 2][w] : 0.0;
    for (std::size_t k = 0; k < taps / 2; ++k)
      sum += weight[k] * (row[k][w] + row[taps - 1 - k][w]);
    out[w] = sum;
  }
}

void weigh(const std::vector<double>& weights, const std::vector<const double*>& from,
           std::size_t count, double* out) {
  const auto known = weights.size() == kWindow ? &weigh_known<kWindow> : &weigh_known<0>;
  known(weights, from, count, out);
}

// Rows of the moments, filtered along the rows.
class RowFilter {
 public:
  RowFilter(const Grid<float>& a, const Grid<float>& b, const std::vector<double>& across)
      : a_(a), b_(b), across_(across) {}

  // One after the other kMoments rows of `windows` numbers.
  void fill(int row, std::vector<double>& out) const {
    const auto x = a_.row(row), y = b_.row(row);
    const std::size_t columns = x.size(), windows = columns - across_.size() + 1;
    std::vector<double> products(kMoments * columns);
    for (std::size_t c = 0; c < columns; ++c) {
      const double p = x[c], q = y[c];
      products[c] = p;
      products[columns + c] = q;
      products[2 * columns + c] = p * p;
      products[3 * columns + c] = q * q;
      products[4 * columns + c] = p * q;
    }
    out.resize(kMoments * windows);
    std::vector<const double*> from(across_.size());
    for (std::size_t moment = 0; moment < kMoments; ++moment) {
      for (std::size_t k = 0; k < from.size(); ++k) from[k] = &products[moment * columns + k];
      weigh(across_, from, windows, &out[moment * windows]);
    }
  }

 private:
  const Grid<float>&a_, &b_;
  const std::vector<double>& across_;
};

double similarity(const Moments& m) {
  const auto [x, y, xx, yy, xy] = m;
  const double variance_x = xx - x * x, variance_y = yy - y * y, covariance = xy - x * y;
  return (2.0 * x * y + kC1) * (2.0 * covariance + kC2) /
         ((x * x + y * y + kC1) * (variance_x + variance_y + kC2));
}

struct Found {
  double sum = 0.0;
  std::int64_t windows = 0;  // that count
  StructuralSimilarity best;
};

}  // namespace

StructuralSimilarity structural_similarity(const Grid<float>& reference,
                                           const Grid<float>& candidate,
                                           std::span<const std::uint8_t> mask) {
  const int columns = reference.columns(), rows = reference.rows();
  require(columns >= 1 && rows >= 1 && columns == candidate.columns() && rows == candidate.rows(),
          "two pictures must be of one size, at least 1 x 1, got {} x {} and {} x {}", columns,
          rows, candidate.columns(), candidate.rows());
  require(mask.empty() || mask.size() == reference.values().size(),
          "the mask must have {} pixels, got {}", reference.values().size(), mask.size());
  const std::vector<double> across = gaussian(std::min(kWindow, columns)),
                            down = gaussian(std::min(kWindow, rows));
  const int windows_x = columns - static_cast<int>(across.size()) + 1,
            windows_y = rows - static_cast<int>(down.size()) + 1;
  const RowFilter along_rows(reference, candidate, across);
  const auto width = static_cast<std::size_t>(windows_x);
  std::vector<Found> of_row(static_cast<std::size_t>(windows_y));
  constexpr int kBand = 32;  // rows of windows that share filtered rows
  const int bands = (windows_y + kBand - 1) / kBand;
  parallel_for(bands, 1, [&](std::int64_t band) {
    const int first = static_cast<int>(band) * kBand, end = std::min(first + kBand, windows_y);
    const int needed = end - first + static_cast<int>(down.size()) - 1;
    std::vector<std::vector<double>> filtered(static_cast<std::size_t>(needed));
    for (int k = 0; k < needed; ++k)
      along_rows.fill(first + k, filtered[static_cast<std::size_t>(k)]);
    std::vector<double> sums(kMoments * width);
    std::vector<const double*> from(down.size());
    for (int row = first; row < end; ++row) {
      constexpr std::size_t kPiece = 512;  // that stays in the nearest cache
      for (std::size_t piece = 0; piece < sums.size(); piece += kPiece) {
        for (std::size_t k = 0; k < from.size(); ++k)
          from[k] = &filtered[static_cast<std::size_t>(row - first) + k][piece];
        weigh(down, from, std::min(kPiece, sums.size() - piece), &sums[piece]);
      }
      Found& found = of_row[static_cast<std::size_t>(row)];
      for (std::size_t w = 0; w < width; ++w) {
        const double here = similarity({sums[w], sums[width + w], sums[2 * width + w],
                                        sums[3 * width + w], sums[4 * width + w]});
        const int x = static_cast<int>(w + across.size() / 2);
        const int y = row + static_cast<int>(down.size() / 2);
        if (!mask.empty() && mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                                  static_cast<std::size_t>(x)] == 0)
          continue;
        found.sum += here;
        ++found.windows;
        if (here < found.best.least) {
          found.best.least = here;
          found.best.least_x = x;
          found.best.least_y = y;
        }
      }
    }
  });
  Found all;
  for (const Found& row : of_row) {
    all.sum += row.sum;
    all.windows += row.windows;
    if (row.best.least < all.best.least) all.best = row.best;
  }
  if (all.windows > 0) all.best.mean = all.sum / static_cast<double>(all.windows);
  return all.best;
}

}  // namespace plumb::compare
