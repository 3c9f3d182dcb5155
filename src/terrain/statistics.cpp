#include "terrain/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/reproducible_math.h"

namespace plumb::terrain {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Squared gradients at which the histogram's bins end.
std::array<double, kSlopeBins> bin_ends() {
  std::array<double, kSlopeBins> ends{};
  for (int k = 0; k + 1 < kSlopeBins; ++k) {
    const double tangent = reproducible_tan(radians((k + 1) * kSlopeBinWidth_deg));
    ends[static_cast<std::size_t>(k)] = tangent * tangent;
  }
  ends.back() = kInfinity;
  return ends;
}

/// What one piece of the rows adds up to.
struct Piece {
  std::int64_t heights = 0, cells = 0;
  double sum_m = 0.0, sum_squared_gradient = 0.0, largest_squared_gradient = 0.0;
  PlacedHeight lowest{kInfinity, 0, 0}, highest{-kInfinity, 0, 0};
  NeighbourStep steepest;
  std::array<std::int64_t, kSlopeBins> slopes{};
};

void add_step(Piece& piece, double from, double to, int i, int j, bool northwards) {
  const double rise = std::abs(to - from);
  if (rise > piece.steepest.rise_m) piece.steepest = {rise, i, j, northwards, 0.0};  // not for NaN
}

// Two rows of samples, the second empty beyond the last.
struct Rows {
  std::span<const float> here, north;
};

void add_sample(Piece& piece, const Rows& rows, int i, int j) {
  const auto k = static_cast<std::size_t>(i);
  const double height = rows.here[k];
  if (std::isnan(height)) return;
  ++piece.heights;
  piece.sum_m += height;
  if (height < piece.lowest.height_m) piece.lowest = {height, i, j};
  if (height > piece.highest.height_m) piece.highest = {height, i, j};
  if (k + 1 < rows.here.size()) add_step(piece, height, rows.here[k + 1], i, j, false);
  if (!rows.north.empty()) add_step(piece, height, rows.north[k], i, j, true);
}

void add_cell(Piece& piece, const Heightfield& field, const Rows& rows,
              const std::array<double, kSlopeBins>& ends, int i) {
  const auto k = static_cast<std::size_t>(i);
  const double south_west = rows.here[k], south_east = rows.here[k + 1];
  const double north_west = rows.north[k], north_east = rows.north[k + 1];
  const double east = ((south_east - south_west) + (north_east - north_west)) / (2.0 * field.dx_m);
  const double north = ((north_west - south_west) + (north_east - south_east)) / (2.0 * field.dy_m);
  const double squared = east * east + north * north;
  if (std::isnan(squared)) return;
  ++piece.cells;
  piece.sum_squared_gradient += squared;
  piece.largest_squared_gradient = std::max(piece.largest_squared_gradient, squared);
  const auto bin = std::upper_bound(ends.begin(), ends.end() - 1, squared) - ends.begin();
  ++piece.slopes[static_cast<std::size_t>(bin)];
}

Piece join(Piece left, const Piece& right) {
  left.heights += right.heights;
  left.cells += right.cells;
  left.sum_m += right.sum_m;
  left.sum_squared_gradient += right.sum_squared_gradient;
  left.largest_squared_gradient =
      std::max(left.largest_squared_gradient, right.largest_squared_gradient);
  if (right.lowest.height_m < left.lowest.height_m) left.lowest = right.lowest;
  if (right.highest.height_m > left.highest.height_m) left.highest = right.highest;
  if (right.steepest.rise_m > left.steepest.rise_m) left.steepest = right.steepest;
  for (std::size_t k = 0; k < left.slopes.size(); ++k) left.slopes[k] += right.slopes[k];
  return left;
}

Piece sum_of(const Heightfield& field) {
  const std::array<double, kSlopeBins> ends = bin_ends();
  return parallel_ordered_reduce(
      field.rows(), 32, Piece{},
      [&](std::int64_t begin, std::int64_t end, Piece piece) {
        std::vector<float> here, north;
        for (int j = static_cast<int>(begin); j < end; ++j) {
          Rows rows{field.heights_m.row(j, here), {}};
          if (j + 1 < field.rows()) rows.north = field.heights_m.row(j + 1, north);
          for (int i = 0; i < field.columns(); ++i) {
            add_sample(piece, rows, i, j);
            if (i < field.cell_columns() && j < field.cell_rows()) {
              add_cell(piece, field, rows, ends, i);
            }
          }
        }
        return piece;
      },
      join);
}

double slope_deg(double squared_gradient) {
  return degrees(reproducible_atan(std::sqrt(squared_gradient)));
}

}  // namespace

TerrainStatistics statistics_of(const Heightfield& field) {
  const Piece sum = sum_of(field);
  TerrainStatistics s;
  s.columns = field.columns();
  s.rows = field.rows();
  s.dx_m = field.dx_m;
  s.dy_m = field.dy_m;
  s.width_m = field.cell_columns() * field.dx_m;
  s.height_m = field.cell_rows() * field.dy_m;
  s.heights = sum.heights;
  s.voids = static_cast<std::int64_t>(field.heights_m.size()) - sum.heights;
  if (sum.heights > 0) {
    s.lowest = sum.lowest;
    s.highest = sum.highest;
    s.mean_m = sum.sum_m / static_cast<double>(sum.heights);
  }
  s.cells = sum.cells;
  s.slope_histogram = sum.slopes;
  if (sum.cells > 0) {
    s.rms_slope_deg = slope_deg(sum.sum_squared_gradient / static_cast<double>(sum.cells));
    s.largest_slope_deg = slope_deg(sum.largest_squared_gradient);
  }
  s.steepest_step = sum.steepest;
  const double length_m = sum.steepest.northwards ? field.dy_m : field.dx_m;
  s.steepest_step.slope_deg = degrees(reproducible_atan(sum.steepest.rise_m / length_m));
  return s;
}

}  // namespace plumb::terrain
