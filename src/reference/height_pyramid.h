// A min/max quadtree over the samples of a heightfield (a maximum mipmap with its minima).
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.h"
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
  int columns(int level) const { return levels_[static_cast<std::size_t>(level) - 1].columns(); }
  int rows(int level) const { return levels_[static_cast<std::size_t>(level) - 1].rows(); }
  const HeightRange& node(int level, int i, int j) const {
    return levels_[static_cast<std::size_t>(level) - 1](i, j);
  }
  const HeightRange& root() const { return levels_.back()(0, 0); }
  std::int64_t bytes() const;

 private:
  std::vector<Grid<HeightRange>> levels_;  // levels_[k - 1] is level k
};

}  // namespace plumb::reference
