// The heights that stacks of one layer stand for.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/stacks/triangle_tree.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::stacks {

/// A full-detail triangle of a heightfield: `half` of cell (i, j) as terrain::triangle_index has
/// it.
struct CellHalf {
  int i = 0, j = 0, half = 0;
};

/// A heightfield's own full-detail triangles: the truth of what is drawn for it. Places are metres
/// relative to (origin_m, 0).
class HeightSurface {
 public:
  HeightSurface(const terrain::Heightfield& field, terrain::Diagonal diagonal);

  int cell_columns() const { return columns_ - 1; }  // 0: there is no triangle
  int cell_rows() const { return rows_ - 1; }
  double dx_m() const { return dx_m_; }
  double dy_m() const { return dy_m_; }
  bool rises(int i, int j) const { return terrain::rises_north_east(diagonal_, i, j); }

  /// Whether its three samples do.
  bool exists(const CellHalf& at) const;
  /// Of the plane of a triangle that exists.
  double height_m(const CellHalf& at, double x_m, double y_m) const;
  /// Whether all triangles of the cells that meet a rectangle of the plan exist.
  bool is_whole(const glm::dvec3& low, const glm::dvec3& high) const;

  /// The farthest that a triangle lies above or below the surface, where that exists; < 0 where it
  /// exists nowhere above or below it.
  ///
  /// Both are planes on each piece that one full-detail triangle cuts out of it, so that it is
  /// largest at a piece's corner.
  double off_m(const Corners& triangle) const;

 private:
  float at(int i, int j) const {
    return heights_m_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(i)];
  }

  int columns_, rows_;
  double dx_m_, dy_m_;
  terrain::Diagonal diagonal_;
  std::vector<float> heights_m_;
  /// Triangles that do not exist in the cells south-west of a corner; empty where there are none.
  std::vector<std::uint32_t> missing_;
};

}  // namespace plumb::mesh::stacks
