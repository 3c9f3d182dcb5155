// A regular grid of heights, and how its cells are cut into triangles.
#pragma once

#include <glm/vec2.hpp>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/box.h"
#include "terrain/height_grid.h"

namespace plumb::terrain {

struct StackField;

/// Which of a cell's two diagonals is an edge of the full-detail surface.
enum class Diagonal {
  Alternating,  // both ends have an even column + row: the 4-8 pattern of a fully refined
                // restricted quadtree
  Fixed,        // from the cell's south-east to its north-west corner: a plain index buffer
  Blocks8,      // towards the centre of each block of 8 x 8 cells, quadrant by quadrant: a
                // tessellator's full detail
};

const char* name_of(Diagonal diagonal);  // "alternating", "fixed", "blocks:8"
Diagonal parse_diagonal(const std::string& text);

/// True if the cell whose south-west sample is (i, j) is cut from south-west to north-east.
constexpr bool rises_north_east(Diagonal diagonal, int i, int j) {
  switch (diagonal) {
    case Diagonal::Alternating:
      return ((i ^ j) & 1) == 0;
    case Diagonal::Fixed:
      return false;
    case Diagonal::Blocks8:
      return ((i & 4) == 0) == ((j & 4) == 0);
  }
  return false;
}

/// Where heights come from and what was taken for granted on the way.
struct Provenance {
  std::string source;                   // the argument that gives this terrain again
  std::string format;                   // "GTiff", "PNG", "generated", ...
  int file_columns = 0, file_rows = 0;  // of the whole file, or of the grid made by reprojecting it
  int window_x = 0,
      window_y =
          0;  // of the part that was read, in the file's own columns and rows, from its top left
  std::string crs;            // as the file or the user states it; empty if neither does
  bool is_local = false;      // metres of a plane of its own, laid out from `crs`, not in it
  double height_scale = 1.0;  // metres per stored unit, as applied
  double height_offset_m = 0.0;
  std::int64_t voids_declared = 0;  // samples equal to the file's no-data value (or NaN there)
  std::int64_t voids_not_finite =
      0;  // samples that are NaN or infinite without being declared no-data
  double largest_rounding_m = 0.0;       // of a source that float32 does not hold exactly
  std::vector<std::string> assumptions;  // one sentence each
};

/// "local metres (CRS laid out flat)".
std::string local_system(const std::string& crs);

/// What a terrain's coordinates are metres of: its crs, local_system(crs) if they are metres of a
/// plane of its own, or nothing if no system is known.
std::string system_of_coordinates(const Provenance& provenance);

/// Sample (i, j) stands at origin_m + (i * dx_m, j * dy_m); i runs east, j runs north. NaN is a
/// void: no surface there.
///
/// A sample is a point. A full-detail triangle exists if its three samples do.
///
/// A terrain of stacks is the heightfield of its top surface, and `stacks` what lies below.
struct Heightfield {
  HeightGrid heights_m;
  double dx_m = 1.0;
  double dy_m = 1.0;
  glm::dvec2 origin_m{0.0};
  Provenance provenance;
  std::shared_ptr<const StackField> stacks;  // terrain/stacks/stack_field.h; null: heights alone

  int columns() const { return heights_m.columns(); }
  int rows() const { return heights_m.rows(); }
  bool is_void(int i, int j) const { return heights_m.is_void(i, j); }
  /// Cells across and up; zero where there is a single row or column.
  int cell_columns() const { return columns() > 0 ? columns() - 1 : 0; }
  int cell_rows() const { return rows() > 0 ? rows() - 1 : 0; }
  glm::dvec3 world_origin_m() const { return {origin_m, 0.0}; }
};

/// Number of the full-detail triangle `half` (0 or 1) of cell (i, j): 2 * (j * cell columns + i) +
/// half.
///
/// Half 0 has the cell's south-west sample if the cell rises north-east and then lies south-east of
/// the diagonal (SW, SE, NE), half 1 is (SW, NE, NW); otherwise half 0 is (SW, SE, NW), half 1 is
/// (SE, NE, NW).
constexpr std::uint32_t triangle_index(int cell_columns, int i, int j, int half) {
  return 2u * (static_cast<std::uint32_t>(j) * static_cast<std::uint32_t>(cell_columns) +
               static_cast<std::uint32_t>(i)) +
         static_cast<std::uint32_t>(half);
}

/// Box of all heights, relative to the terrain's origin; empty if everything is void.
Box bounds(const Heightfield& field);

/// Checksum of size, spacing, origin and heights: two terrains with the same one are the same
/// terrain.
std::uint64_t checksum(const Heightfield& field);

/// Throws std::invalid_argument unless both sizes are at least 1, the spacings positive and finite,
/// no height infinite and the triangles countable in 32 bits.
void require_valid(const Heightfield& field);

}  // namespace plumb::terrain
