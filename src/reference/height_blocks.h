// A heightfield's full-detail triangles in blocks of a few cells, for a tree of boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/box.h"
#include "reference/ray_triangle.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// Squares of kSide x kSide cells (fewer at the east and north borders) that may hold a triangle,
/// in the order of their rows. Keeps a reference to the field. Coordinates are relative to the
/// terrain's origin.
class HeightBlocks {
 public:
  static constexpr int kSide = 4;

  HeightBlocks(const terrain::Heightfield& field, terrain::Diagonal diagonal);

  std::uint32_t count() const { return static_cast<std::uint32_t>(blocks_.size()); }
  /// Box of all samples of block k.
  Box box(std::uint32_t k) const;
  /// Improves `best` by the triangles of block k that the ray meets at t in [t_min, t_max]; of
  /// equal t the lowest triangle_index stays.
  void meet(std::uint32_t k, const RayFrame& frame, double t_min, double t_max, RayHit& best) const;

 private:
  struct Extent {
    int i0, j0, columns, rows;  // in samples: one more than in cells
  };
  Extent extent(std::uint32_t k) const;

  const terrain::Heightfield& field_;
  terrain::Diagonal diagonal_;
  int across_ = 0;                     // blocks in a row
  std::vector<std::uint32_t> blocks_;  // row * across_ + column
};

}  // namespace plumb::reference
