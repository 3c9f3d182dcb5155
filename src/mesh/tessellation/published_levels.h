// The paper's choice of tessellation factors within one patch.
#pragma once

#include "mesh/tessellation/block_levels.h"

namespace plumb::mesh::tessellation {

/// lambda^(d) of every block, d from 0 (zero) to log2(block_cells), metres: block by block, row by
/// row.
class BlockErrors {
 public:
  /// `mixed`: the largest of any mixture that a block of inner d may be drawn with, between the
  /// samples too; otherwise as printed, at samples, under one factor.
  BlockErrors(const BlockPieces& pieces, const Grid<float>& heights_m, bool mixed);

  double lambda_m(int i, int j, int level) const {
    return errors_m_[(static_cast<std::size_t>(j) * static_cast<std::size_t>(blocks_) +
                      static_cast<std::size_t>(i)) *
                         static_cast<std::size_t>(levels_) +
                     static_cast<std::size_t>(level)];
  }

 private:
  int blocks_, levels_;
  std::vector<double> errors_m_;
};

/// Factors of a patch's blocks by projected lengths at the middles of their sides.
/// Source: [Yusov & Shevtsov 2011, section 5, "Fine-Grain Level of Detail Selection"].
PatchLevels published_levels(const Prepared& prepared, const ViewTest& view,
                             const patch_quadtree::PatchPlace& patch, const Grid<float>& heights_m,
                             LevelCounts& counts);

}  // namespace plumb::mesh::tessellation
