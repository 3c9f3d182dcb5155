#include "terrain/void_fill.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace plumb::terrain {
namespace {

constexpr int kNowhere = -1;

std::int64_t count_voids(const Heightfield& field) {
  return parallel_ordered_reduce(
      field.rows(), 64, std::int64_t{0},
      [&](std::int64_t begin, std::int64_t end, std::int64_t count) {
        for (std::int64_t j = begin; j < end; ++j) {
          for (int i = 0; i < field.columns(); ++i) {
            count += field.is_void(i, static_cast<int>(j)) ? 1 : 0;
          }
        }
        return count;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
}

/// The row of the nearest sample in each sample's own column (the lower of two); kNowhere in a
/// column of voids.
Grid<int> nearest_rows(const Heightfield& field) {
  Grid<int> nearest(field.columns(), field.rows(), kNowhere);
  constexpr int kStrip = 64;  // columns side by side, so that a strip's rows share cache lines
  const int strips = (field.columns() + kStrip - 1) / kStrip;
  parallel_for(strips, 1, [&](std::int64_t strip) {
    const int begin = static_cast<int>(strip) * kStrip;
    const int end = std::min(begin + kStrip, field.columns());
    for (int j = 0; j < field.rows(); ++j) {
      for (int i = begin; i < end; ++i) {
        nearest(i, j) = !field.is_void(i, j) ? j : j > 0 ? nearest(i, j - 1) : kNowhere;
      }
    }
    for (int j = field.rows() - 2; j >= 0; --j) {
      for (int i = begin; i < end; ++i) {
        const int above = nearest(i, j + 1);
        const int below = nearest(i, j);
        if (above > j && (below == kNowhere || above - j < j - below)) nearest(i, j) = above;
      }
    }
  });
  return nearest;
}

/// Lower envelope of the parabolas (x - i)^2 dx^2 + distance_i^2, one for each column of a row.
class Envelope {
 public:
  Envelope(double dx_m, double dy_m) : dx_m_(dx_m), dy_m_(dy_m) {}

  void build(const Grid<int>& nearest, int j) {
    columns_.clear();
    starts_.clear();
    for (int i = 0; i < nearest.columns(); ++i) {
      if (nearest(i, j) == kNowhere) continue;
      const double height = squared(nearest(i, j) - j);
      while (!columns_.empty()) {
        const double start = crossing(columns_.back(), height_of(nearest, j), i, height);
        if (start > starts_.back()) {
          columns_.push_back(i);
          starts_.push_back(start);
          break;
        }
        columns_.pop_back();
        starts_.pop_back();
      }
      if (columns_.empty()) {
        columns_.push_back(i);
        starts_.push_back(-std::numeric_limits<double>::infinity());
      }
    }
  }

  bool empty() const { return columns_.empty(); }

  /// The column whose parabola is lowest at column i; calls come with rising i, from `k` = 0.
  int column_at(int i, std::size_t& k) const {
    while (k + 1 < columns_.size() && starts_[k + 1] < i) ++k;
    return columns_[k];
  }

 private:
  double squared(int rows) const { return (rows * dy_m_) * (rows * dy_m_); }
  double height_of(const Grid<int>& nearest, int j) const {
    return squared(nearest(columns_.back(), j) - j);
  }
  /// The column position right of which the parabola at `right` is the lower one.
  double crossing(int left, double left_height, int right, double right_height) const {
    const double scale = dx_m_ * dx_m_;
    return 0.5 * (left + right) + (right_height - left_height) / (2.0 * scale * (right - left));
  }

  double dx_m_, dy_m_;
  std::vector<int> columns_;
  std::vector<double> starts_;
};

}  // namespace

std::int64_t fill_voids(Heightfield& field) {
  const std::int64_t voids = count_voids(field);
  if (voids == 0) return 0;
  const Grid<int> nearest = nearest_rows(field);
  // In place: only voids are written, and only samples that never were void are read.
  parallel_for(field.rows(), 8, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    Envelope envelope(field.dx_m, field.dy_m);
    envelope.build(nearest, j);
    if (envelope.empty()) return;
    std::size_t k = 0;
    for (int i = 0; i < field.columns(); ++i) {
      const int column = envelope.column_at(i, k);
      if (field.is_void(i, j)) field.heights_m.copy(column, nearest(column, j), i, j);
    }
  });
  return voids;
}

}  // namespace plumb::terrain
