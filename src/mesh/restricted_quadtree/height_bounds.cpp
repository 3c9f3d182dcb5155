#include "mesh/restricted_quadtree/height_bounds.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/parallel.h"

namespace plumb::mesh::restricted_quadtree {

HeightBounds::Range HeightBounds::join(Range a, Range b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

HeightBounds::HeightBounds(const terrain::Heightfield& field) : field_(field) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr Range kNone{kInfinity, -kInfinity};
  const int cells = std::max(field.cell_columns(), field.cell_rows());
  for (int side = 2; side / 2 < cells; side *= 2) {
    const int columns = (field.cell_columns() + side - 1) / side,
              rows = (field.cell_rows() + side - 1) / side;
    Grid<Range> level(columns, rows, kNone);
    const Grid<Range>* finer = levels_.empty() ? nullptr : &levels_.back();
    parallel_for(rows, 8, [&](std::int64_t row) {
      const int j = static_cast<int>(row);
      for (int i = 0; i < columns; ++i) {
        Range range = kNone;
        if (finer != nullptr) {
          for (int b = 2 * j; b < std::min(2 * j + 2, finer->rows()); ++b) {
            for (int a = 2 * i; a < std::min(2 * i + 2, finer->columns()); ++a)
              range = join(range, (*finer)(a, b));
          }
        } else {
          for (int b = 2 * j; b <= std::min(2 * j + 2, field.rows() - 1); ++b) {
            for (int a = 2 * i; a <= std::min(2 * i + 2, field.columns() - 1); ++a) {
              const float height = field.heights_m(a, b);
              if (!field.is_void(a, b)) range = join(range, {height, height});
            }
          }
        }
        level(i, j) = range;
      }
    });
    levels_.push_back(std::move(level));
  }
}

HeightBounds::Range HeightBounds::square(int level, int i, int j) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Grid<Range>& ranges = levels_[static_cast<std::size_t>(level) - 1];
  return ranges.contains(i, j) ? ranges(i, j) : Range{kInfinity, -kInfinity};
}

Box HeightBounds::box(const BinTriangle& t) const {
  const auto [i0, i1] = std::minmax({t.a.i, t.b.i, t.c.i});
  const auto [j0, j1] = std::minmax({t.a.j, t.b.j, t.c.j});
  // A square, or two squares side by side; the smallest of these are single cells, looked up in the
  // square around them.
  const int side = std::min(i1 - i0, j1 - j0);
  const int level = std::max(1, static_cast<int>(std::countr_zero(static_cast<unsigned>(side))));
  Range range = square(level, i0 >> level, j0 >> level);
  range = join(range, square(level, (i1 - 1) >> level, (j1 - 1) >> level));
  Box box;
  if (range.low <= range.high) {
    box.low = {i0 * field_.dx_m, j0 * field_.dy_m, range.low};
    box.high = {i1 * field_.dx_m, j1 * field_.dy_m, range.high};
  }
  return box;
}

std::int64_t HeightBounds::bytes() const {
  std::int64_t sum = 0;
  for (const auto& level : levels_) sum += static_cast<std::int64_t>(level.size() * sizeof(Range));
  return sum;
}

}  // namespace plumb::mesh::restricted_quadtree
