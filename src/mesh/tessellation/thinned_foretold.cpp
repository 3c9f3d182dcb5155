#include "mesh/tessellation/thinned_foretold.h"

#include <algorithm>
#include <cmath>

namespace plumb::mesh::tessellation {
namespace {

BlockPlaces even_places(int cells) {
  BlockPlaces places;
  for (int k = 0; k <= cells; ++k) places.column.push_back(k);
  places.row = places.column;
  return places;
}

}  // namespace

ThinnedForetold::ThinnedForetold(const BlockPieces& pieces)
    : cells_(pieces.block_cells()),
      coarsest_(pieces.coarsest()),
      whole_(pieces.whole(), even_places(cells_), cells_) {
  const BlockPlaces places = even_places(cells_);
  for (int inside = 0; inside < coarsest_; ++inside) {
    interior_.emplace_back(pieces.interior(inside), places, cells_);
    for (std::size_t side = 0; side < 4; ++side) {
      for (int along = 0; along <= coarsest_; ++along)
        strips_.emplace_back(pieces.strip(inside, side, along), places, cells_);
    }
  }
}

double ThinnedForetold::strips(std::span<const double> drawn_m, const TruthBelow& own, int inside,
                               int along) const {
  double largest = 0.0;
  for (int side = 0; side < 4; ++side) {
    const auto at = static_cast<std::size_t>((inside * 4 + side) * (coarsest_ + 1) + along);
    largest = std::max(largest, strips_[at].deviation(drawn_m, own));
  }
  return largest;
}

std::vector<double> ThinnedForetold::distances_m(const patch_quadtree::PatchLayout& layout,
                                                 const patch_quadtree::PatchPlace& patch,
                                                 const Grid<float>& heights_m) const {
  const int blocks = (heights_m.columns() - 3) / cells_;
  std::vector<double> distances, drawn_m;
  distances.reserve(static_cast<std::size_t>(blocks * blocks * (coarsest_ + 1)));
  for (int j = 0; j < blocks; ++j) {
    for (int i = 0; i < blocks; ++i) {
      drawn_m.clear();
      bool has_void = false;
      for (int b = 0; b <= cells_; ++b) {
        for (int a = 0; a <= cells_; ++a) {
          drawn_m.push_back(double{heights_m(i * cells_ + a + 1, j * cells_ + b + 1)});
          has_void = has_void || std::isnan(drawn_m.back());
        }
      }
      const bool beyond =
          layout.sample_column(patch, i * cells_) ==
              layout.sample_column(patch, (i + 1) * cells_) ||
          layout.sample_row(patch, j * cells_) == layout.sample_row(patch, (j + 1) * cells_);
      if (has_void || beyond) {
        distances.insert(distances.end(), static_cast<std::size_t>(coarsest_) + 1, -1.0);
        continue;
      }
      const TruthBelow own{&heights_m(i * cells_ + 1, j * cells_ + 1), heights_m.columns()};
      distances.push_back(0.0);
      double largest = 0.0;
      for (int inside = 1; inside < coarsest_; ++inside) {
        largest = interior_[static_cast<std::size_t>(inside)].deviation(drawn_m, own);
        for (int along = 0; along <= inside; ++along)
          largest = std::max(largest, strips(drawn_m, own, inside, along));
        distances.push_back(largest);
      }
      distances.push_back(std::max({largest, strips(drawn_m, own, coarsest_ - 1, coarsest_),
                                    whole_.deviation(drawn_m, own)}));
    }
  }
  return distances;
}

}  // namespace plumb::mesh::tessellation
