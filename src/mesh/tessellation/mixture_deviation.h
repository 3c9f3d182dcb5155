// How far a block lies from a surface beneath, at the worst of the mixtures that it may be drawn
// as.
#pragma once

#include <span>
#include <vector>

#include "mesh/tessellation/block_pieces.h"
#include "mesh/tessellation/piece_deviation.h"

namespace plumb::mesh::tessellation {

/// The pieces of a block over a surface, see PieceGeometry.
class MixtureDeviation {
 public:
  MixtureDeviation(const BlockPieces& pieces, const BlockPlaces& places,
                   int truth_block = kTruthBlockCells);

  /// visit(thinning, metres) for each thinning from `first` on, rising: the largest deviation of
  /// any mixture whose inside is thinned so far and whose sides are no coarser.
  template <class Visit>
  void for_each_thinning(int first, std::span<const double> drawn_m, const TruthBelow& truth,
                         const Visit& visit) const {
    double largest = 0.0;
    for (int inside = first; inside < coarsest_; ++inside) {
      largest = of_inside(inside, drawn_m, truth);
      visit(inside, largest);
    }
    visit(coarsest_, of_coarsest(largest, drawn_m, truth));
  }

 private:
  double of_inside(int inside, std::span<const double> drawn_m, const TruthBelow& truth) const;
  /// An inside of one segment beside other factors is the one before it, whose deviation is given.
  double of_coarsest(double of_last, std::span<const double> drawn_m,
                     const TruthBelow& truth) const;
  double of_strips(int inside, int along, std::span<const double> drawn_m,
                   const TruthBelow& truth) const;

  int coarsest_;
  std::vector<PieceGeometry> interior_, strips_;  // in the order of BlockPieces
  PieceGeometry whole_;
};

}  // namespace plumb::mesh::tessellation
