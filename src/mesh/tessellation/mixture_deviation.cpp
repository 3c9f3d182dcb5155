#include "mesh/tessellation/mixture_deviation.h"

#include <algorithm>

namespace plumb::mesh::tessellation {

MixtureDeviation::MixtureDeviation(const BlockPieces& pieces, const BlockPlaces& places,
                                   int truth_block)
    : coarsest_(pieces.coarsest()), whole_(pieces.whole(), places, truth_block) {
  for (int inside = 0; inside < coarsest_; ++inside) {
    interior_.emplace_back(pieces.interior(inside), places, truth_block);
    for (std::size_t side = 0; side < 4; ++side) {
      for (int along = 0; along <= coarsest_; ++along)
        strips_.emplace_back(pieces.strip(inside, side, along), places, truth_block);
    }
  }
}

double MixtureDeviation::of_strips(int inside, int along, std::span<const double> drawn_m,
                                   const TruthBelow& truth) const {
  double largest = 0.0;
  for (int side = 0; side < 4; ++side) {
    const auto at = static_cast<std::size_t>((inside * 4 + side) * (coarsest_ + 1) + along);
    largest = std::max(largest, strips_[at].deviation(drawn_m, truth));
  }
  return largest;
}

double MixtureDeviation::of_inside(int inside, std::span<const double> drawn_m,
                                   const TruthBelow& truth) const {
  double largest = interior_[static_cast<std::size_t>(inside)].deviation(drawn_m, truth);
  for (int along = 0; along <= inside; ++along)
    largest = std::max(largest, of_strips(inside, along, drawn_m, truth));
  return largest;
}

double MixtureDeviation::of_coarsest(double of_last, std::span<const double> drawn_m,
                                     const TruthBelow& truth) const {
  return std::max({of_last, of_strips(coarsest_ - 1, coarsest_, drawn_m, truth),
                   whole_.deviation(drawn_m, truth)});
}

}  // namespace plumb::mesh::tessellation
