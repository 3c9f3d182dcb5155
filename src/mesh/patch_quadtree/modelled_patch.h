// Version 2 of the codec: a patch foretold from its parent's samples, what is left coded by what is
// around it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/byte_stream.h"
#include "mesh/patch_quadtree/child_samples.h"
#include "mesh/patch_quadtree/patch_numbers.h"
#include "mesh/patch_quadtree/rans.h"

namespace plumb::mesh::patch_quadtree {

/// Contexts differ by level (the finest, the next, all others), by kind of sample (centres; Across
/// and Up) and by how lively it is around.
inline constexpr int kLevelGroups = 3, kSampleKinds = 2;
inline constexpr std::size_t kModels =
    static_cast<std::size_t>(kLevelGroups) * kSampleKinds * kContexts;

/// How often each symbol stood in each context, over a whole terrain.
struct SymbolCounts {
  std::array<std::array<std::uint64_t, kRansSymbols>, kModels> counts{};

  void add(const SymbolCounts& other);
};

/// Tables of all contexts, in the order of SymbolCounts.
struct ModelTables {
  std::vector<RansTable> tables;  // kModels
};

/// A child of a patch: (s, t) of it, at its level.
struct ChildPlace {
  int s = 0, t = 0, level = 0;
};

void count_symbols(const PatchNumbers& parent, const ChildPlace& place, const PatchNumbers& child,
                   SymbolCounts& counts);

/// The child's record. Parent and child have the same step, and agree on the samples they share.
Bytes encode_child(const PatchNumbers& parent, const ChildPlace& place, const PatchNumbers& child,
                   const ModelTables& tables);
/// The child again, its voids' numbers zero. False if the bytes are no such record.
bool decode_child(const PatchNumbers& parent, const ChildPlace& place,
                  std::span<const std::uint8_t> bytes, const ModelTables& tables,
                  PatchNumbers& child);

/// The patch that has no parent: numbers foretold from those before, by an adaptive model.
Bytes encode_root(const PatchNumbers& root);
bool decode_root(std::span<const std::uint8_t> bytes, int patch_cells, StepRule rule,
                 PatchNumbers& root);

}  // namespace plumb::mesh::patch_quadtree
