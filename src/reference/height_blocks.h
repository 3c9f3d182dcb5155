// A heightfield's full-detail triangles in blocks of a few cells, for a tree of boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/box.h"
#include "core/triangle_mesh.h"
#include "reference/block_sides.h"
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
  /// Samples of a block relative to a point, kept from one ray to the next.
  struct Scratch {
    std::uint32_t block = kNoPrimitive;
    glm::dvec3 from_m{0.0};
    BlockSamples at;
  };
  /// Improves `best` by the triangles of block k that the ray meets at t in [t_min, t_max]; of
  /// equal t the lowest triangle_index stays.
  void meet(std::uint32_t k, const RayFrame& frame, double t_min, double t_max, RayHit& best,
            Scratch& samples) const;

 private:
  struct Extent {
    int i0, j0, columns, rows;  // in samples: one more than in cells
  };
  Extent extent(std::uint32_t k) const;
  glm::dvec2 corner(const Extent& e, int a, int b, const glm::dvec3& from_m, double share) const;
  void gather(std::uint32_t k, const glm::dvec3& from_m, Scratch& samples) const;

  const terrain::Heightfield& field_;
  terrain::Diagonal diagonal_;
  FindBlockSides find_sides_;
  int across_ = 0;                     // blocks in a row
  std::vector<std::uint32_t> blocks_;  // row * across_ + column
};

}  // namespace plumb::reference
