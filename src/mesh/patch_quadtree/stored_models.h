// The models of version 2 as the header of a container holds them.
#pragma once

#include <optional>
#include <span>

#include "mesh/patch_quadtree/byte_stream.h"
#include "mesh/patch_quadtree/modelled_patch.h"

namespace plumb::mesh::patch_quadtree {

/// A bit for each context that occurs, then for each of these its 16 frequencies, two bytes each.
Bytes stored_models(const SymbolCounts& counts);

/// Nothing if the bytes are no models.
std::optional<ModelTables> models_of(std::span<const std::uint8_t> bytes);

}  // namespace plumb::mesh::patch_quadtree
