// Which patches of the quadtree a frame draws.
#pragma once

#include <cstdint>
#include <vector>

#include "core/box.h"
#include "core/grid.h"
#include "mesh/tessellation/tessellation.h"
#include "mesh/tessellation/view_test.h"

namespace plumb::mesh::tessellation {

/// The quadtree's patches as a frame has them, by their number.
struct PatchSelection {
  static constexpr std::int32_t kLeftOut = -1, kAbove = -2;

  /// Place in `drawn`; kAbove of patches whose children are drawn instead, kLeftOut of all others.
  std::vector<std::int32_t> state;
  std::vector<patch_quadtree::PatchPlace> drawn;  // by their numbers: the coarsest first
  std::int64_t visited = 0;
  std::int64_t tested = 0;  // of these, what the error decided: not the finest, not void
  /// Patches that the published test lets pass and that would be refined were it mended; by error
  /// those alone whose bound as drawn is finite: amid voids the children are always drawn instead.
  std::int64_t finer_by_distance = 0, finer_by_error = 0;
};

/// Patches until each keeps the tolerance, or is of the finest level. Those that are all void are
/// left out.
PatchSelection select_patches(const Prepared& prepared, const ViewTest& view);

/// How many of the drawn patches the camera may see anything of (may_be_in_view, of their boxes).
std::int64_t patches_in_view(const Prepared& prepared, const ViewTest& view,
                             const PatchSelection& selection);

/// Of a patch: its samples' extent, heights as the bounds say, widened by what decoding may add.
Box box_of(const Prepared& prepared, const patch_quadtree::PatchPlace& patch);

/// Heights of the drawn patches, (n + 3)^2 each, decoded on all threads.
std::vector<Grid<float>> decode_drawn(const Prepared& prepared, const PatchSelection& selection);

}  // namespace plumb::mesh::tessellation
