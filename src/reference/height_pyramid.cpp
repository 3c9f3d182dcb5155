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

}  // namespace

void HeightPyramid::lay_out(int cell_columns, int cell_rows) {
  std::size_t count = 0;
  int columns = cell_columns, rows = cell_rows;
  do {
    columns = (columns + 1) / 2;
    rows = (rows + 1) / 2;
    levels_.push_back({count, columns, rows});
    count += static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  } while (columns > 1 || rows > 1);
  ranges_.assign(count, kNone);
}

void HeightPyramid::fill_finest(const terrain::Heightfield& field) {
  const Level level = levels_.front();
  const int cells_x = field.cell_columns(), cells_y = field.cell_rows();
  parallel_for(level.rows, 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < level.columns; ++i) {
      at(level, i, j) = range_of_samples(field, 2 * i, 2 * j, std::min(2 * i + 2, cells_x),
                                         std::min(2 * j + 2, cells_y));
    }
  });
}

void HeightPyramid::fill_coarser(const Level& fine, const Level& coarse) {
  parallel_for(coarse.rows, 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < coarse.columns; ++i) {
      HeightRange range = kNone;
      for (int b = 2 * j; b < std::min(2 * j + 2, fine.rows); ++b) {
        for (int a = 2 * i; a < std::min(2 * i + 2, fine.columns); ++a) {
          range.low = std::min(range.low, at(fine, a, b).low);
          range.high = std::max(range.high, at(fine, a, b).high);
        }
      }
      at(coarse, i, j) = range;
    }
  });
}

HeightPyramid::HeightPyramid(const terrain::Heightfield& field) {
  const bool has_cells = field.cell_columns() > 0 && field.cell_rows() > 0;
  lay_out(has_cells ? field.cell_columns() : 1, has_cells ? field.cell_rows() : 1);
  if (!has_cells) return;
  fill_finest(field);
  for (std::size_t k = 1; k < levels_.size(); ++k) fill_coarser(levels_[k - 1], levels_[k]);
}

std::int64_t HeightPyramid::bytes() const {
  return static_cast<std::int64_t>(ranges_.size() * sizeof(HeightRange));
}

}  // namespace plumb::reference
