// A min/max quadtree over the samples of a heightfield (a maximum mipmap with its minima).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "terrain/heightfield.h"

namespace plumb::reference {

/// Least and greatest height of the samples under a node; low > high where every one is void.
struct HeightRange {
  float low;
  float high;
  bool empty() const { return !(low <= high); }
};

inline constexpr HeightRange kEmptyRange{std::numeric_limits<float>::infinity(),
                                         -std::numeric_limits<float>::infinity()};

/// The same by the terrain's own codes, both of a void where every sample is one.
struct CodeRange {
  std::uint16_t low;
  std::uint16_t high;
};

/// Level k >= 1 has a node for each square of 2^k x 2^k cells, counted from the south-west; a
/// node's samples are the (2^k + 1)^2 that its cells touch. Level 0 are the cells themselves and is
/// not stored: 8 bytes for every 4 cells, and a third more for all the coarser levels together,
/// which is 1.33 bytes a triangle; half of that where the terrain's heights are codes of 16 bits,
/// as the ranges are then too. The top level has a single node.
///
/// A pyramid of a terrain without cells has one empty node.
class HeightPyramid {
 public:
  explicit HeightPyramid(const terrain::Heightfield& field);

  int top_level() const { return static_cast<int>(levels_.size()); }
  int columns(int level) const { return of(level).columns; }
  int rows(int level) const { return of(level).rows; }
  HeightRange node(int level, int i, int j) const {
    const Level& l = of(level);
    return range(l.begin + static_cast<std::size_t>(j) * static_cast<std::size_t>(l.columns) +
                 static_cast<std::size_t>(i));
  }
  HeightRange root() const { return range(levels_.back().begin); }
  std::int64_t bytes() const;

  /// All nodes, level 1 first, row by row, null where they are kept the other way; and where a
  /// level's begin.
  const HeightRange* ranges() const { return ranges_.empty() ? nullptr : ranges_.data(); }
  const CodeRange* codes() const { return codes_.empty() ? nullptr : codes_.data(); }
  std::size_t begin(int level) const { return of(level).begin; }

 private:
  struct Level {
    std::size_t begin;
    int columns, rows;
  };
  const Level& of(int level) const { return levels_[static_cast<std::size_t>(level) - 1]; }
  HeightRange range(std::size_t k) const {
    if (codes_.empty()) return ranges_[k];
    const CodeRange& range = codes_[k];
    if (range.low == coding_.void_code) return kEmptyRange;
    return {coding_.height_m(range.low), coding_.height_m(range.high)};
  }
  void lay_out(int cell_columns, int cell_rows);

  std::vector<HeightRange> ranges_;  // one of these two is empty
  std::vector<CodeRange> codes_;
  terrain::HeightCoding coding_;
  std::vector<Level> levels_;  // levels_[k - 1] is level k
};

}  // namespace plumb::reference
