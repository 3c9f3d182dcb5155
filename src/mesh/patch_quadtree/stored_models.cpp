#include "mesh/patch_quadtree/stored_models.h"

#include <algorithm>
#include <array>

namespace plumb::mesh::patch_quadtree {

Bytes stored_models(const SymbolCounts& counts) {
  Bytes used((kModels + 7) / 8, 0), bytes;
  for (std::size_t m = 0; m < kModels; ++m) {
    const auto& symbols = counts.counts[m];
    if (std::all_of(symbols.begin(), symbols.end(), [](std::uint64_t n) { return n == 0; }))
      continue;
    used[m / 8] = static_cast<std::uint8_t>(used[m / 8] | 1u << m % 8);
    for (const std::uint16_t frequency : rans_frequencies(symbols)) {
      bytes.push_back(static_cast<std::uint8_t>(frequency));
      bytes.push_back(static_cast<std::uint8_t>(frequency >> 8));
    }
  }
  used.insert(used.end(), bytes.begin(), bytes.end());
  return used;
}

std::optional<ModelTables> models_of(std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  const auto used = reader.bytes((kModels + 7) / 8);
  std::array<RansFrequencies, kModels> frequencies;
  frequencies.fill(rans_frequencies(std::array<std::uint64_t, kRansSymbols>{}));
  for (std::size_t m = 0; m < kModels && !reader.overrun(); ++m) {
    if ((used[m / 8] >> m % 8 & 1u) == 0) continue;
    std::uint32_t sum = 0;
    for (std::uint16_t& frequency : frequencies[m]) {
      const std::uint32_t low = reader.byte();
      frequency = static_cast<std::uint16_t>(low | std::uint32_t{reader.byte()} << 8);
      if (frequency == 0 || frequency >= kRansTotal) return std::nullopt;
      sum += frequency;
    }
    if (sum != kRansTotal) return std::nullopt;
  }
  if (reader.overrun() || !reader.rest().empty()) return std::nullopt;
  return ModelTables(frequencies);
}

}  // namespace plumb::mesh::patch_quadtree
