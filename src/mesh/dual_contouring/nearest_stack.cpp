#include "mesh/dual_contouring/nearest_stack.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr int kNone = -1;

// For each place the row of the nearest stack of its column that is no hole, the lower of two.
std::vector<int> nearest_in_column(const terrain::StackField& field) {
  std::vector<int> nearest(field.size(), kNone);
  for (int i = 0; i < field.columns; ++i) {
    int below = kNone;
    for (int j = 0; j < field.rows; ++j) {
      if (!field.is_hole(i, j)) below = j;
      nearest[field.index(i, j)] = below;
    }
    int above = kNone;
    for (int j = field.rows - 1; j >= 0; --j) {
      if (!field.is_hole(i, j)) above = j;
      int& best = nearest[field.index(i, j)];
      if (above != kNone && (best == kNone || above - j < j - best)) best = above;
    }
  }
  return nearest;
}

// Columns further and further away, until none can hold a nearer stack.
std::uint32_t nearest_to(const terrain::StackField& field, const std::vector<int>& in_column, int i,
                         int j) {
  using Rank = std::tuple<std::int64_t, int, int>;  // squared distance, row, column
  Rank best{std::numeric_limits<std::int64_t>::max(), 0, 0};
  const int furthest = std::max(i, field.columns - 1 - i);
  for (std::int64_t away = 0; away <= furthest && away * away <= std::get<0>(best); ++away) {
    for (const std::int64_t column : {i - away, i + away}) {
      if (column < 0 || column >= field.columns) continue;
      const int row = in_column[field.index(static_cast<int>(column), j)];
      if (row == kNone) continue;
      const std::int64_t up = row - j;
      best = std::min(best, Rank{away * away + up * up, row, static_cast<int>(column)});
    }
  }
  return static_cast<std::uint32_t>(field.index(std::get<2>(best), std::get<1>(best)));
}

}  // namespace

NearestStacks::NearestStacks(const terrain::StackField& field)
    : columns_(field.columns), rows_(field.rows) {
  require(field.size() > 0, "a field without stacks has no density");
  if (std::none_of(field.holes.begin(), field.holes.end(), [](auto hole) { return hole != 0; }))
    return;
  require(std::any_of(field.holes.begin(), field.holes.end(), [](auto hole) { return hole == 0; }),
          "a field of holes alone has no density");
  require(field.size() <= std::numeric_limits<std::uint32_t>::max(),
          "a field with holes has at most 2^32 - 1 stacks");
  const std::vector<int> in_column = nearest_in_column(field);
  index_.resize(field.size());
  parallel_for(rows_, 4, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < columns_; ++i) {
      const std::size_t here = field.index(i, j);
      index_[here] = field.is_hole(i, j) ? nearest_to(field, in_column, i, j)
                                         : static_cast<std::uint32_t>(here);
    }
  });
}

std::size_t NearestStacks::at(int i, int j) const {
  const auto inside =
      static_cast<std::size_t>(std::clamp(j, 0, rows_ - 1)) * static_cast<std::size_t>(columns_) +
      static_cast<std::size_t>(std::clamp(i, 0, columns_ - 1));
  return index_.empty() ? inside : index_[inside];
}

}  // namespace plumb::mesh::dual_contouring
