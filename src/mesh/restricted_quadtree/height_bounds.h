// Least and greatest heights under squares of the tree, for boxes around triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/box.h"
#include "core/grid.h"
#include "mesh/restricted_quadtree/bintree.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::restricted_quadtree {

/// For every aligned square of 2^k cells a side, k >= 1, the range of its (2^k + 1)^2 samples.
class HeightBounds {
 public:
  explicit HeightBounds(const terrain::Heightfield& field);

  /// A box that holds every sample under the triangle, and so the triangle itself if its corners
  /// are samples. Relative to the terrain's origin; empty if all samples there are void. The
  /// triangle is larger than the finest size.
  Box box(const BinTriangle& triangle) const;
  std::int64_t bytes() const;

 private:
  struct Range {
    float low, high;
  };
  static Range join(Range a, Range b);
  Range square(int level, int i, int j) const;

  const terrain::Heightfield& field_;
  std::vector<Grid<Range>> levels_;  // levels_[k - 1]: squares of 2^k cells
};

}  // namespace plumb::mesh::restricted_quadtree
