// A terrain as a file that can be drawn from: coded heights, and bounds for each patch.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/patch_quadtree/coded_terrain.h"
#include "mesh/patch_quadtree/container.h"
#include "mesh/patch_quadtree/rans_models.h"
#include "mesh/tessellation/patch_bounds.h"
#include "mesh/tessellation/thinned_foretold.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::tessellation {

struct BuildOptions {
  patch_quadtree::EncodeOptions heights;
  int block_cells = 8;  // a power of two from 8 to 64, at most patch_cells
};

/// The whole file, of payload Tessellation; the same bytes on any number of threads.
///
///   (1) What encode_heights promises of heights.
///   (2) Every patch's bounds hold for what is drawn from the heights as they are decoded.
/// Throws as encode_heights does, and std::invalid_argument for other block_cells.
Bytes build(const terrain::Heightfield& field, const BuildOptions& options);

/// What a file says beside heights: bounds of all patches by their number, but for those of
/// thinnings.
struct Bounds {
  int block_cells = 8;
  BoundScale scale;
  std::vector<patch_quadtree::RansTable> tables;
  std::vector<PatchBounds> patches;

  /// Err(P), metres.
  double error_m(std::int64_t patch) const {
    return scale.value(patches[static_cast<std::size_t>(patch)].error_code());
  }
};

/// Throws InputError, naming the patch, if the container has another payload or is damaged.
Bounds read_bounds(const patch_quadtree::Container& container);

/// All bounds of one patch, by its heights as they are decoded. Throws InputError, naming it, if
/// they are damaged.
PatchBounds thinned_bounds(const patch_quadtree::Container& container, const Bounds& bounds,
                           const ThinnedForetold& foretold, std::int64_t patch,
                           const Grid<float>& heights_m);

}  // namespace plumb::mesh::tessellation
