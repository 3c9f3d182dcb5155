#include "reference/height_pyramid.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"

namespace plumb::reference {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr HeightRange kNone{kInfinity, -kInfinity};

HeightRange range_of_samples(const terrain::Heightfield& field, int i0, int j0, int i1, int j1) {
  HeightRange range = kNone;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const float height = field.heights_m(i, j);
      range.low = height < range.low ? height : range.low;  // false for a void, which is NaN
      range.high = height > range.high ? height : range.high;
    }
  }
  return range;
}

Grid<HeightRange> finest_level(const terrain::Heightfield& field) {
  const int cells_x = field.cell_columns(), cells_y = field.cell_rows();
  Grid<HeightRange> level((cells_x + 1) / 2, (cells_y + 1) / 2, kNone);
  parallel_for(level.rows(), 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < level.columns(); ++i) {
      level(i, j) = range_of_samples(field, 2 * i, 2 * j, std::min(2 * i + 2, cells_x),
                                     std::min(2 * j + 2, cells_y));
    }
  });
  return level;
}

Grid<HeightRange> coarser_level(const Grid<HeightRange>& fine) {
  Grid<HeightRange> level((fine.columns() + 1) / 2, (fine.rows() + 1) / 2, kNone);
  parallel_for(level.rows(), 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < level.columns(); ++i) {
      HeightRange range = kNone;
      for (int b = 2 * j; b < std::min(2 * j + 2, fine.rows()); ++b) {
        for (int a = 2 * i; a < std::min(2 * i + 2, fine.columns()); ++a) {
          range.low = std::min(range.low, fine(a, b).low);
          range.high = std::max(range.high, fine(a, b).high);
        }
      }
      level(i, j) = range;
    }
  });
  return level;
}

}  // namespace

HeightPyramid::HeightPyramid(const terrain::Heightfield& field) {
  if (field.cell_columns() == 0 || field.cell_rows() == 0) {
    levels_.emplace_back(1, 1, kNone);
    return;
  }
  levels_.push_back(finest_level(field));
  while (levels_.back().size() > 1) levels_.push_back(coarser_level(levels_.back()));
}

std::int64_t HeightPyramid::bytes() const {
  std::int64_t sum = 0;
  for (const auto& level : levels_)
    sum += static_cast<std::int64_t>(level.size() * sizeof(HeightRange));
  return sum;
}

}  // namespace plumb::reference
