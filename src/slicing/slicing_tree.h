// A quadtree of bounding boxes over a heightfield: what slices are put into.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/box.h"
#include "terrain/heightfield.h"

namespace plumb::slicing {

/// A square of cells and the box of its surface.
struct SlicingNode {
  Box box;                // relative to the terrain's origin; empty where nothing exists
  int i0 = 0, j0 = 0;     // its south-west sample
  int i1 = 0, j1 = 0;     // its north-east sample, cut to the terrain
  bool complete = true;   // every cell of its square lies on the terrain and has two triangles
  bool inland = true;     // so have all cells around it: no rim and no void touches it
  double steepest = 0.0;  // slope of the steepest triangle in it or in the cells around it, m/m
  bool empty() const { return box.empty(); }
};

/// Nodes level by level from the root; level k has 2^k x 2^k of them, row by row from the south.
///
/// Leaves are squares of `leaf_cells` cells; 1025 x 1025 samples and leaves of 8 cells make 21,845
/// nodes. A terrain whose cells are not leaf_cells * 2^n is padded to the north and the east: a
/// node's box ends where the terrain does, nodes beyond it are empty.
/// Source: [Röttger & Ertl 2001], section 3.
class SlicingTree {
 public:
  /// leaf_cells  even, 2..256. Keeps a reference to the terrain.
  SlicingTree(const terrain::Heightfield& field, terrain::Diagonal diagonal, int leaf_cells = 8);

  const terrain::Heightfield& field() const { return *field_; }
  terrain::Diagonal diagonal() const { return diagonal_; }
  int leaf_cells() const { return leaf_cells_; }
  int levels() const { return levels_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(nodes_.size()); }
  const SlicingNode& node(std::uint32_t index) const { return nodes_[index]; }

  int level_of(std::uint32_t index) const;
  bool is_leaf(std::uint32_t index) const { return index >= first_of(levels_ - 1); }
  /// South-west, south-east, north-west, north-east.
  std::array<std::uint32_t, 4> children(std::uint32_t index) const;

  /// Index of the first node of a level: (4^level - 1) / 3.
  static std::uint32_t first_of(int level) { return ((std::uint32_t{1} << (2 * level)) - 1) / 3; }

 private:
  void fill_leaf(std::uint32_t index, int column, int row);
  void fill_inner(std::uint32_t index);
  bool is_surrounded(const SlicingNode& node) const;

  const terrain::Heightfield* field_;
  terrain::Diagonal diagonal_;
  int leaf_cells_;
  int levels_;
  std::vector<SlicingNode> nodes_;
};

}  // namespace plumb::slicing
