// How far pieces of a drawn block lie from the full-detail surface beneath, as drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tessellation/block_pieces.h"
#include "mesh/tessellation/block_shapes.h"

namespace plumb::mesh::tessellation {

/// The full-detail heights beneath a block: sample (i, j) from its south-west corner at
/// first[j stride + i].
struct TruthBelow {
  const float* first = nullptr;
  std::ptrdiff_t stride = 0;
};

/// Everything about a piece that heights do not change: which samples its triangles cover, and
/// where drawn edges cross edges of the truth between samples. The difference of two surfaces that
/// are linear between these places is largest at one of them.
class PieceGeometry {
 public:
  /// The truth's diagonals point to the centres of blocks of `truth_block` cells, a power of two,
  /// the first of which begins where this block does: of `blocks:8`, 8.
  PieceGeometry(const std::vector<BlockTriangle>& triangles, const BlockPlaces& places,
                int truth_block = kTruthBlockCells);

  /// The largest |drawn - truth|, metres, but for rounding (a few times 1e-16 of the heights);
  /// drawn_m holds (block_cells + 1)^2 heights row by row. Where a height is NaN nothing is
  /// measured.
  double deviation(std::span<const double> drawn_m, const TruthBelow& truth) const;
  /// The same at the samples alone.
  double sample_deviation(std::span<const double> drawn_m, const TruthBelow& truth) const;

 private:
  struct Place {
    int column, row;
  };
  // Columns [begin, end) of a row.
  struct Span {
    int row, begin, end;
  };
  // Slopes are (east, north) of a rise of one from corner 0 to corner 1, and to corner 2.
  struct Plane {
    std::array<std::uint32_t, 3> corner;
    Place at;  // of corner 0
    std::array<double, 2> slope_1, slope_2;
    std::size_t first_span, last_span;
  };
  // `along` of the way on a drawn edge, `across` of the way on an edge of the truth from a to b.
  struct Crossing {
    std::uint32_t from, to;
    Place a, b;
    double along, across;
  };

  Place place(const BlockPoint& point, const BlockPlaces& places) const;
  std::uint32_t number(const BlockPoint& point) const {
    return static_cast<std::uint32_t>(point.j * side_ + point.i);
  }
  void add_plane(const BlockTriangle& triangle, const BlockPlaces& places);
  void add_spans(const std::array<Place, 3>& corners);
  void add_crossings(const BlockPoint& from, const BlockPoint& to, const BlockPlaces& places);

  bool rises(int column, int row) const {
    return ((column & truth_half_) == 0) == ((row & truth_half_) == 0);
  }

  int side_;        // block_cells + 1
  int truth_half_;  // half of truth_block
  std::vector<Span> spans_;
  std::vector<Plane> planes_;
  std::vector<Crossing> crossings_;
};

}  // namespace plumb::mesh::tessellation
