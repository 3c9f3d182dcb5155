#include "mesh/patch_quadtree/patch_numbers.h"

#include <cmath>
#include <limits>

namespace plumb::mesh::patch_quadtree {

PatchNumbers numbers_of(const terrain::HeightGrid& heights_m, const PatchLayout& layout,
                        const PatchPlace& patch, const Quantiser& quantiser) {
  const int side = layout.side();
  PatchNumbers numbers{Grid<std::int32_t>(side, side), {}};
  for (int j = 0; j < side; ++j) {
    const int row = layout.sample_row(patch, j - 1);
    for (int i = 0; i < side; ++i) {
      const float height = heights_m(layout.sample_column(patch, i - 1), row);
      if (std::isnan(height)) {
        if (!numbers.has_voids()) numbers.voids = Grid<std::uint8_t>(side, side);
        numbers.voids(i, j) = 1;
      } else {
        numbers.q(i, j) = quantiser.number(height, patch.level);
      }
    }
  }
  return numbers;
}

Grid<float> heights_of(const PatchNumbers& numbers, const Quantiser& quantiser, int level) {
  Grid<float> heights(numbers.q.columns(), numbers.q.rows());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    heights.values()[k] = numbers.has_voids() && numbers.voids.values()[k] != 0
                              ? std::numeric_limits<float>::quiet_NaN()
                              : quantiser.height(numbers.q.values()[k], level);
  }
  return heights;
}

}  // namespace plumb::mesh::patch_quadtree
