// A heightfield's full-detail triangles in blocks of a few cells, for a tree of boxes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/box.h"
#include "core/camera.h"
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

  /// `seen_by`, in world coordinates: only blocks that its picture may show.
  HeightBlocks(const terrain::Heightfield& field, terrain::Diagonal diagonal,
               const std::optional<Camera>& seen_by = std::nullopt);

  std::uint32_t count() const { return static_cast<std::uint32_t>(blocks_.size()); }
  /// Box of all samples of block k.
  Box box(std::uint32_t k) const;
  /// A block relative to a point, kept from one ray to the next.
  struct Scratch {
    std::uint32_t block = kNoPrimitive;
    glm::dvec3 from_m{0.0};
    glm::dvec2 low{0.0}, high{0.0};  // its rectangle, a little larger
    bool sampled = false;            // `at` is filled in
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
  Extent extent_at(int column, int row) const;
  Box box_of(const Extent& extent) const;
  void place(std::uint32_t k, const glm::dvec3& from_m, Scratch& block) const;
  void sample(Scratch& block) const;

  const terrain::Heightfield& field_;
  terrain::Diagonal diagonal_;
  FindBlockSides find_sides_;
  struct Place {
    std::uint16_t column, row;  // of blocks: enough for 2^18 cells a side
  };
  std::vector<Place> blocks_;
};

}  // namespace plumb::reference
