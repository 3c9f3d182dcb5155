#include "mesh/tessellation/thinned_foretold.h"

#include <cmath>

namespace plumb::mesh::tessellation {

ThinnedForetold::ThinnedForetold(const BlockPieces& pieces)
    : cells_(pieces.block_cells()),
      coarsest_(pieces.coarsest()),
      block_(pieces, even_places(cells_), cells_) {}

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
      if (has_void || !shape_of(layout, patch, cells_, i, j)) {
        distances.insert(distances.end(), static_cast<std::size_t>(coarsest_) + 1, -1.0);
        continue;
      }
      const TruthBelow own{&heights_m(i * cells_ + 1, j * cells_ + 1), heights_m.columns()};
      distances.push_back(0.0);
      block_.for_each_thinning(1, drawn_m, own,
                               [&](int, double distance) { distances.push_back(distance); });
    }
  }
  return distances;
}

}  // namespace plumb::mesh::tessellation
