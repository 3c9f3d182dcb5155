// Tessellation factors of the drawn patches, block by block, as a GPU would hold them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grid.h"
#include "mesh/tessellation/patch_selection.h"

namespace plumb::mesh::tessellation {

/// A patch's blocks: how far each is thinned, and what is promised of it.
struct PatchLevels {
  Grid<BlockLevels> levels;  // block i of row j; factor block_cells / 2^d
  Grid<double> bound_m;      // of each block as it is drawn; metres, of the method's variant
};

/// What the frame's choice says of itself.
struct LevelCounts {
  std::int64_t blocks = 0, sides = 0;         // that were decided
  std::int64_t unreachable = 0;               // blocks at full detail that miss the tolerance
  double worst_m = 0.0;                       // of these, metres
  double worst_reach = 0.0;                   // of these, in the tolerance's unit
  std::array<std::int64_t, kCauses> finer{};  // decisions that mending a cause would make finer

  void add(const LevelCounts& other);
};

struct ChosenLevels {
  std::vector<PatchLevels> patches;  // as PatchSelection::drawn
  LevelCounts counts;
};

/// The tessellation factors of all drawn patches.
///
///   (1) Blocks of patches of one level agree on the side they share: `conservative` takes the
///   finer of the two; `published` within a patch alone.
ChosenLevels choose_levels(const Prepared& prepared, const ViewTest& view,
                           const PatchSelection& selection,
                           const std::vector<Grid<float>>& heights_m);

/// A block's samples within a patch's (n + 3)^2: their places and heights. Empty if all are void.
Box box_of_samples(const Prepared& prepared, const patch_quadtree::PatchPlace& patch,
                   const Grid<float>& heights_m, int first_i, int first_j, int last_i, int last_j);

}  // namespace plumb::mesh::tessellation
