// The cells that have vertices, and which numbers their vertices and faces get.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/dual_contouring/cell_loops.h"
#include "mesh/dual_contouring/classification.h"
#include "mesh/dual_contouring/lattice.h"

namespace plumb::mesh::dual_contouring {

enum class Variant {
  Published,     // one vertex a cell [Löffler, Müller & Schumann 2011]
  Conservative,  // one for each loop: a manifold
};

const char* name_of(Variant variant);  // "published", "conservative"

struct ActiveCell {
  std::int32_t x = 0;              // from the box's low
  std::uint32_t first_vertex = 0;  // the others follow, in the order of their loops
  CellMask mask = 0;
  std::uint8_t vertices = 0;  // 1 to 4
  bool split = false;         // both cells at its face_to_split cut off that face's outside

  friend bool operator==(const ActiveCell&, const ActiveCell&) = default;
};

/// The cells whose eight samples are not all alike, by z, y, x, and the first vertex and the first
/// face of each row of cells.
///
///   (1) Vertices are numbered by cell, x fastest, then y, z, then by the loop's lowest edge.
///   (2) Faces are numbered by the lower end p of their edge, then axis x, y, z.
///   (3) Numbers come from prefix sums: the same on any number of threads.
struct ActiveCells {
  Variant variant = Variant::Conservative;
  LatticeBox box;                         // of all cells
  LatticeBox edges;                       // the lower ends of the edges that get faces
  std::vector<std::uint32_t> first_cell;  // of each row (y, z), y fastest; one more at the end
  std::vector<std::uint32_t> first_quad;  // the same
  std::vector<ActiveCell> cells;
  std::uint32_t vertices = 0;

  std::size_t rows() const { return first_cell.size() - 1; }
  std::size_t row(int y, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(box.size.y) +
           static_cast<std::size_t>(y);
  }
  /// The lower corner of a cell of a row.
  glm::ivec3 place(std::size_t row, const ActiveCell& cell) const {
    const auto width = static_cast<std::size_t>(box.size.y);
    return box.low +
           glm::ivec3(cell.x, static_cast<int>(row % width), static_cast<int>(row / width));
  }
  const CellLoops& loops(const ActiveCell& cell) const {
    return variant == Variant::Published ? single_loop(cell.mask)
                                         : manifold_loops(cell.mask, cell.split);
  }
};

/// Of all cells of the lattice. Splits are decided for cells whose neighbour lies in it too.
/// Throws std::invalid_argument for more than 2^32 - 2 vertices or faces.
/// Source: [Löffler, Müller & Schumann 2011, section 3.2.3], with prefix sums for its atomic
/// counters.
ActiveCells allocate(const Lattice<float>& density, Variant variant);

/// Of a block of voxels, as the nodes of an octree are: the edges whose lower end is one of them
/// get faces, their cells and the ones one before on every axis vertices. What lies round them is
/// seen: with two more samples on every side, blocks of one field agree on the cells that they
/// share, and each edge belongs to one block.
/// Throws std::invalid_argument for cells beyond the lattice, too.
ActiveCells allocate(const Lattice<float>& density, Variant variant, const LatticeBox& voxels);

}  // namespace plumb::mesh::dual_contouring
