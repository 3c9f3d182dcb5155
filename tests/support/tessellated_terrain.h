// Terrains prepared for tessellation, and blocks of theirs as triangles.
#pragma once

#include <vector>

#include "mesh/tessellation/tessellation.h"
#include "support/slow_deviation.h"

namespace plumb::test_support {

namespace tessellation = mesh::tessellation;

/// A block of a patch as drawn from heights of a decoder.
inline std::vector<DrawnTriangle> triangles_of_block(const tessellation::Prepared& prepared,
                                                     const mesh::patch_quadtree::PatchPlace& patch,
                                                     const Grid<float>& heights_m, int block_i,
                                                     int block_j,
                                                     const tessellation::BlockLevels& levels) {
  const auto& layout = prepared.header().layout;
  const int cells = prepared.pieces->block_cells();
  std::vector<DrawnTriangle> triangles;
  prepared.pieces->for_each_piece(levels, [&](const auto& piece) {
    for (const tessellation::BlockTriangle& t : piece) {
      DrawnTriangle corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const int i = block_i * cells + t[k].i, j = block_j * cells + t[k].j;
        corners[k] = {layout.sample_column(patch, i), layout.sample_row(patch, j),
                      double{heights_m(i + 1, j + 1)}};
      }
      triangles.push_back(corners);
    }
  });
  return triangles;
}

}  // namespace plumb::test_support
