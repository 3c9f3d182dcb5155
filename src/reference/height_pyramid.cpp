#include "reference/height_pyramid.h"

#include <algorithm>

#include "core/parallel.h"

namespace plumb::reference {
namespace {

// Ranges as they are kept (Range) and as they are added up (Sum), for heights that are floats.
struct OfFloats {
  using Range = HeightRange;
  using Sum = HeightRange;
  static constexpr Sum kNone = kEmptyRange;
  const float* heights;

  void add(Sum& sum, std::size_t sample) const {
    const float height = heights[sample];
    sum.low = height < sum.low ? height : sum.low;  // false for a void, which is NaN
    sum.high = height > sum.high ? height : sum.high;
  }
  void add(Sum& sum, const Range& range) const {
    sum.low = std::min(sum.low, range.low);
    sum.high = std::max(sum.high, range.high);
  }
  Range range_of(const Sum& sum) const { return sum; }
};

// The same for codes, which are ordered as their heights are.
struct OfCodes {
  using Range = CodeRange;
  struct Sum {
    int low, high;
  };
  static constexpr Sum kNone{65536, -1};
  const std::uint16_t* codes;
  int void_code;

  void add(Sum& sum, std::size_t sample) const { add(sum, Range{codes[sample], codes[sample]}); }
  void add(Sum& sum, const Range& range) const {
    const bool empty = range.low == void_code;
    sum.low = std::min(sum.low, empty ? kNone.low : range.low);
    sum.high = std::max(sum.high, empty ? kNone.high : range.high);
  }
  // Nothing is empty unless there are voids, and then they have a code.
  Range range_of(const Sum& sum) const {
    const bool empty = sum.high < 0;
    return {static_cast<std::uint16_t>(empty ? void_code : sum.low),
            static_cast<std::uint16_t>(empty ? void_code : sum.high)};
  }
};

// Gives each node of a level its range.
template <class Level, class Range, class Of>
void fill(const Level& level, std::vector<Range>& ranges, const Of& range_at) {
  parallel_for(level.rows, 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    Range* range = &ranges[level.begin +
                           static_cast<std::size_t>(j) * static_cast<std::size_t>(level.columns)];
    for (int i = 0; i < level.columns; ++i) *range++ = range_at(i, j);
  });
}

template <class Kind>
typename Kind::Range range_of_samples(const Kind& kind, const terrain::Heightfield& field, int i,
                                      int j) {
  const int i1 = std::min(2 * i + 2, field.cell_columns());
  const int j1 = std::min(2 * j + 2, field.cell_rows());
  typename Kind::Sum sum = Kind::kNone;
  for (int b = 2 * j; b <= j1; ++b) {
    for (int a = 2 * i; a <= i1; ++a) kind.add(sum, field.heights_m.index(a, b));
  }
  return kind.range_of(sum);
}

template <class Kind, class Level>
typename Kind::Range range_of_children(const Kind& kind, const Level& fine,
                                       const std::vector<typename Kind::Range>& ranges, int i,
                                       int j) {
  typename Kind::Sum sum = Kind::kNone;
  for (int b = 2 * j; b < std::min(2 * j + 2, fine.rows); ++b) {
    for (int a = 2 * i; a < std::min(2 * i + 2, fine.columns); ++a) {
      kind.add(
          sum,
          ranges[fine.begin + static_cast<std::size_t>(b) * static_cast<std::size_t>(fine.columns) +
                 static_cast<std::size_t>(a)]);
    }
  }
  return kind.range_of(sum);
}

template <class Kind, class Levels>
std::vector<typename Kind::Range> ranges_of(const Kind& kind, const terrain::Heightfield& field,
                                            const Levels& levels) {
  std::vector<typename Kind::Range> ranges(levels.back().begin + 1);
  fill(levels.front(), ranges, [&](int i, int j) { return range_of_samples(kind, field, i, j); });
  for (std::size_t k = 1; k < levels.size(); ++k) {
    fill(levels[k], ranges,
         [&](int i, int j) { return range_of_children(kind, levels[k - 1], ranges, i, j); });
  }
  return ranges;
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
}

HeightPyramid::HeightPyramid(const terrain::Heightfield& field) {
  const bool has_cells = field.cell_columns() > 0 && field.cell_rows() > 0;
  lay_out(has_cells ? field.cell_columns() : 1, has_cells ? field.cell_rows() : 1);
  const terrain::HeightGrid& heights = field.heights_m;
  if (!has_cells) {
    ranges_.push_back(kEmptyRange);
  } else if (heights.is_coded()) {
    coding_ = heights.coding();
    codes_ =
        ranges_of(OfCodes{heights.as_codes()->values().data(), coding_.void_code}, field, levels_);
  } else {
    ranges_ = ranges_of(OfFloats{heights.as_floats()->values().data()}, field, levels_);
  }
}

std::int64_t HeightPyramid::bytes() const {
  return static_cast<std::int64_t>(ranges_.size() * sizeof(HeightRange) +
                                   codes_.size() * sizeof(CodeRange));
}

}  // namespace plumb::reference
