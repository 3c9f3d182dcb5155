// The vertical error of every triangle of the tree, over all samples that it covers.
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid.h"
#include "mesh/restricted_quadtree/bintree.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::restricted_quadtree {

/// Errors of all triangles above the finest size, two for each sample that is a base vertex.
///
/// A triangle is
///   complete, if every full-detail triangle under it exists: its error is the largest vertical
///   distance between its plane
///     and the samples that it covers, edges included, rounded up to float32 (metres, >= 0);
///   broken, if some of them exist and some do not (voids, the terrain's border): kBroken, it
///   cannot be drawn; empty, if none exists: kEmpty, there is nothing to draw.
/// The tree stands over the square of 2^n cells that holds the terrain, its south-west corner at
/// sample (0, 0).
class TriangleErrors {
 public:
  static constexpr float kEmpty = -1.0f;
  static const float kBroken;  // +inf

  /// Looks at every sample once for each level of the tree. Work O(N log N), memory 8 bytes a
  /// sample.
  explicit TriangleErrors(const terrain::Heightfield& field);

  int root_side() const { return root_side_; }  // cells along the root square, a power of two
  /// Error of a triangle that is not of the finest size; kEmpty or kBroken if it reaches beyond the
  /// terrain.
  float error(const BinTriangle& triangle) const;
  /// True if the half cell's three samples exist.
  bool finest_exists(const BinTriangle& triangle) const;
  std::int64_t bytes() const { return static_cast<std::int64_t>(errors_.size() * sizeof(float)); }

 private:
  float stored(Corner v, int side) const {
    return errors_[2 * field_.heights_m.index(v.i, v.j) + static_cast<std::size_t>(side)];
  }
  float state_of_child(const BinTriangle& child) const;
  float compute(const Grid<float>& heights_m, Corner v, int side) const;
  void fill_level(const Grid<float>& heights_m, int half, bool centres);

  const terrain::Heightfield& field_;
  int root_side_ = 1;
  std::vector<float>
      errors_;  // [sample][side]; unused for samples that are corners of the root square
};

}  // namespace plumb::mesh::restricted_quadtree
