// Tables of several contexts as a file holds them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/byte_stream.h"
#include "mesh/patch_quadtree/rans.h"

namespace plumb::mesh::patch_quadtree {

/// How often each symbol occurs in a context.
using RansCounts = std::array<std::uint64_t, kRansSymbols>;

/// A bit for each context that occurs, then for each of these 16 frequencies as numbers
/// (put_number).
Bytes rans_model_bytes(std::span<const RansCounts> contexts);

/// The tables again, `contexts` of them; nothing if the bytes are none of theirs.
std::optional<std::vector<RansTable>> rans_tables_of(std::span<const std::uint8_t> bytes,
                                                     std::size_t contexts);

}  // namespace plumb::mesh::patch_quadtree
