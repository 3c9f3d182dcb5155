// A patch's bounds as bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/patch_quadtree/byte_stream.h"
#include "mesh/patch_quadtree/rans_models.h"
#include "mesh/tessellation/patch_bounds.h"

namespace plumb::mesh::tessellation {

/// Contexts of the symbols of bounds: by thinning and by how alike the two neighbours are, for the
/// upper bits of what is not foretold; by thinning for the lower two.
std::size_t bound_contexts(int levels);

/// Adds up what a patch's symbols are; `counts` has bound_contexts(levels) entries.
void count_bounds(const PatchBounds& bounds, std::span<patch_quadtree::RansCounts> counts);

patch_quadtree::Bytes encode_bounds(const PatchBounds& bounds,
                                    std::span<const patch_quadtree::RansTable> tables);

/// The same again; false if the bytes are no such record. `blocks` and `levels` are those of the
/// file.
bool decode_bounds(std::span<const std::uint8_t> bytes, int blocks, int levels,
                   std::span<const patch_quadtree::RansTable> tables, PatchBounds& bounds);

}  // namespace plumb::mesh::tessellation
