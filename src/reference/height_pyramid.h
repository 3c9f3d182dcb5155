// A min/max quadtree over the samples of a heightfield (a maximum mipmap with its minima).
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/heightfield.h"

namespace plumb::reference {

/// Least and greatest height of the samples under a node; low > high where every one is void.
struct HeightRange {
  float low;
  float high;
  bool empty() const { return !(low <= high); }
};

/// Level k >= 1 has a node for each square of 2^k x 2^k cells, counted from the south-west; a
/// node's samples are the (2^k + 1)^2 that its cells touch. Level 0 are the cells themselves and is
/// not stored: 8 bytes for every 4 cells, and a third more for all the coarser levels together,
/// which is 1.33 bytes a triangle. The top level has a single node.
///
/// A pyramid of a terrain without cells has one empty node.
class HeightPyramid {
 public:
  explicit HeightPyramid(const terrain::Heightfield& field);

  int top_level() const { return static_cast<int>(levels_.size()); }
  int columns(int level) const { return of(level).columns; }
  int rows(int level) const { return of(level).rows; }
  const HeightRange& node(int level, int i, int j) const {
    const Level& l = of(level);
    return ranges_[l.begin + static_cast<std::size_t>(j) * static_cast<std::size_t>(l.columns) +
                   static_cast<std::size_t>(i)];
  }
  const HeightRange& root() const { return ranges_.back(); }
  std::int64_t bytes() const;

  /// All nodes, level 1 first, row by row; and where a level's begin.
  const std::vector<HeightRange>& nodes() const { return ranges_; }
  std::size_t begin(int level) const { return of(level).begin; }

 private:
  struct Level {
    std::size_t begin;
    int columns, rows;
  };
  const Level& of(int level) const { return levels_[static_cast<std::size_t>(level) - 1]; }
  HeightRange& at(const Level& level, int i, int j) {
    return ranges_[level.begin +
                   static_cast<std::size_t>(j) * static_cast<std::size_t>(level.columns) +
                   static_cast<std::size_t>(i)];
  }
  void lay_out(int cell_columns, int cell_rows);
  void fill_finest(const terrain::Heightfield& field);
  void fill_coarser(const Level& fine, const Level& coarse);

  std::vector<HeightRange> ranges_;
  std::vector<Level> levels_;  // levels_[k - 1] is level k
};

}  // namespace plumb::reference
