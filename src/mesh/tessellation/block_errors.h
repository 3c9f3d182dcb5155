// How far a thinned block lies from its patch's own samples: the paper's lambda.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/patch_quadtree/patch_layout.h"
#include "mesh/tessellation/block_pieces.h"
#include "mesh/tessellation/block_shapes.h"

namespace plumb::mesh::tessellation {

/// lambda^(d) of one block, d from 0 (zero) to the coarsest thinning, metres. Infinite where a
/// triangle with a void corner would cover a sample that exists and is none of its corners, or a
/// triangle without one a void.
struct BlockErrors {
  std::vector<double> printed_m;     // at samples, under one factor all round
  std::vector<double> mixed_m;       // inside d, sides no coarser; between the samples too
  std::vector<double> any_inside_m;  // the same, and of any inside no coarser the strips as well
};

/// A block's pieces over its patch's samples, wherever these stand: at the terrain's edge cells are
/// narrower, or nothing. Heights are (block_cells + 1)^2, row by row, metres, NaN for a void.
class BlockGeometry {
 public:
  BlockGeometry(const BlockPieces& pieces, const BlockPlaces& places);

  BlockErrors errors(std::span<const double> heights_m) const;
  /// The largest vertical distance, metres, between the block as drawn and as full detail draws the
  /// same samples, between them too; where either is void nothing is measured.
  double drawn_error_m(const BlockLevels& levels, std::span<const double> heights_m) const;

 private:
  // At a sample, and there or where two edges cross.
  struct Deviation {
    double at_samples_m = 0.0, anywhere_m = 0.0;
  };
  // What a triangle covers beside its corners, by weights of corners 1 and 2.
  struct Covered {
    std::uint32_t sample;
    double weight_1, weight_2;
  };
  struct Plane {
    std::array<std::uint32_t, 3> corner;
    std::size_t first, last;  // of covered
  };
  // `along` of the way on a drawn edge, `across` of the way on an edge of full detail from a to b.
  struct Crossing {
    std::uint32_t from, to, a, b;
    double along, across;
  };
  struct Piece {
    std::vector<Plane> planes;
    std::vector<Covered> covered;
    std::vector<Crossing> crossings;
  };

  Piece piece_of(const std::vector<BlockTriangle>& triangles, const BlockPlaces& places) const;
  void add_plane(const BlockTriangle& triangle, const BlockPlaces& places, Piece& piece) const;
  void add_crossings(const BlockPoint& from, const BlockPoint& to, const BlockPlaces& places,
                     Piece& piece) const;
  std::uint32_t number(int i, int j) const {
    return static_cast<std::uint32_t>(j * (cells_ + 1) + i);
  }
  const Piece& strip(int inside, std::size_t side, int along) const {
    return strips_[(static_cast<std::size_t>(inside) * 4 + side) *
                       static_cast<std::size_t>(coarsest_ + 1) +
                   static_cast<std::size_t>(along)];
  }
  static Deviation deviation(const Piece& piece, std::span<const double> heights_m);
  static bool changes_outline(const Piece& piece, std::span<const double> heights_m);

  int cells_, coarsest_;
  std::vector<Piece> interior_, strips_;  // in the order of BlockPieces
  Piece whole_;
};

/// The geometry of every block of a terrain's patches.
class BlockGeometries {
 public:
  BlockGeometries(const BlockPieces& pieces, const patch_quadtree::PatchLayout& layout);

  /// Of block i of row j of a patch; null if it lies beyond the terrain, where nothing is drawn.
  const BlockGeometry* of(const patch_quadtree::PatchPlace& patch, int i, int j) const;

 private:
  patch_quadtree::PatchLayout layout_;
  int cells_;
  BlockGeometry whole_;
  std::vector<std::optional<BlockGeometry>> cut_off_;  // shapes of level 0, then of level 1, ...
};

}  // namespace plumb::mesh::tessellation
