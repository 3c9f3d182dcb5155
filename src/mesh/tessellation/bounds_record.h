// A patch's bounds as bytes: what selecting patches needs first, then what drawing one needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/byte_stream.h"
#include "mesh/patch_quadtree/rans_models.h"
#include "mesh/tessellation/patch_bounds.h"

namespace plumb::mesh::tessellation {

/// Contexts of the symbols of bounds: of full detail, by how alike the two neighbours are and for
/// the lower bits; of thinnings, by thinning and by what is foretold against the bound of full
/// detail.
std::size_t bound_contexts(int levels);

/// What foretells a patch's thinned bounds: ThinnedForetold's distances of its heights.
struct ForetoldBounds {
  std::span<const double> distances_m;
  BoundScale scale;
};

/// Adds up what a patch's symbols are; `counts` has bound_contexts(levels) entries.
void count_bounds(const PatchBounds& bounds, const ForetoldBounds& foretold,
                  std::span<patch_quadtree::RansCounts> counts);

Bytes encode_bounds(const PatchBounds& bounds, const ForetoldBounds& foretold,
                    std::span<const patch_quadtree::RansTable> tables);

/// Everything but the bounds of thinnings, which are none; false if the bytes are no such record.
/// `blocks` and `levels` are those of the file.
bool decode_bounds(std::span<const std::uint8_t> bytes, int blocks, int levels,
                   std::span<const patch_quadtree::RansTable> tables, PatchBounds& bounds);

/// The bounds of thinnings too, of what decode_bounds gave; false if the bytes are no such record.
bool decode_thinned(std::span<const std::uint8_t> bytes, const ForetoldBounds& foretold,
                    std::span<const patch_quadtree::RansTable> tables, PatchBounds& bounds);

}  // namespace plumb::mesh::tessellation
