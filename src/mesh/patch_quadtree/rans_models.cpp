#include "mesh/patch_quadtree/rans_models.h"

#include <algorithm>

namespace plumb::mesh::patch_quadtree {

Bytes rans_model_bytes(std::span<const RansCounts> contexts) {
  Bytes used((contexts.size() + 7) / 8, 0), bytes;
  for (std::size_t m = 0; m < contexts.size(); ++m) {
    const RansCounts& symbols = contexts[m];
    if (std::all_of(symbols.begin(), symbols.end(), [](std::uint64_t n) { return n == 0; }))
      continue;
    used[m / 8] = static_cast<std::uint8_t>(used[m / 8] | 1u << m % 8);
    for (const std::uint16_t frequency : rans_frequencies(symbols)) put_number(frequency, bytes);
  }
  used.insert(used.end(), bytes.begin(), bytes.end());
  return used;
}

std::optional<std::vector<RansTable>> rans_tables_of(std::span<const std::uint8_t> bytes,
                                                     std::size_t contexts) {
  ByteReader reader(bytes);
  const auto used = reader.bytes((contexts + 7) / 8);
  const RansFrequencies even = rans_frequencies(RansCounts{});
  std::vector<RansTable> tables;
  tables.reserve(contexts);
  for (std::size_t m = 0; m < contexts && !reader.overrun(); ++m) {
    RansFrequencies frequencies = even;
    if ((used[m / 8] >> m % 8 & 1u) != 0) {
      std::uint32_t sum = 0;
      for (std::uint16_t& frequency : frequencies) {
        const std::uint64_t number = reader.number();
        if (number == 0 || number >= kRansTotal) return std::nullopt;
        frequency = static_cast<std::uint16_t>(number);
        sum += frequency;
      }
      if (sum != kRansTotal) return std::nullopt;
    }
    tables.emplace_back(frequencies);
  }
  if (reader.overrun() || !reader.rest().empty()) return std::nullopt;
  return tables;
}

}  // namespace plumb::mesh::patch_quadtree
