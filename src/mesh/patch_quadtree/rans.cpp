#include "mesh/patch_quadtree/rans.h"

#include <algorithm>
#include <numeric>

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr std::uint32_t kLeastState = 1u << 16;

}  // namespace

RansFrequencies rans_frequencies(std::span<const std::uint64_t> counts) {
  const std::uint64_t all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  RansFrequencies frequencies;
  std::uint32_t used = 0;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    const std::uint64_t share = all > 0 ? counts[k] * (kRansTotal - kRansSymbols) / all : 0;
    frequencies[k] = static_cast<std::uint16_t>(1 + share);
    used += frequencies[k];
  }
  const auto most = std::max_element(frequencies.begin(), frequencies.end());
  *most = static_cast<std::uint16_t>(*most + kRansTotal - used);
  return frequencies;
}

RansTable::RansTable(const RansFrequencies& frequencies) : frequency(frequencies) {
  slot.resize(kRansTotal);
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    start[k + 1] = static_cast<std::uint16_t>(start[k] + frequencies[k]);
    for (std::uint32_t within = 0; within < frequencies[k]; ++within)
      slot[start[k] + within] =
          static_cast<std::uint32_t>(k) | (frequencies[k] - 1u) << 4 | within << 17;
  }
}

std::vector<std::uint8_t> rans_encode(std::span<const RansSymbol> symbols) {
  std::array<std::uint32_t, kRansStates> states;
  states.fill(kLeastState);
  std::vector<std::uint8_t> backwards;
  for (std::size_t k = symbols.size(); k-- > 0;) {
    std::uint32_t& state = states[k % kRansStates];
    const RansTable& table = *symbols[k].table;
    const std::uint32_t frequency = table.frequency[symbols[k].symbol];
    if (state >= (frequency << (32 - kRansBits))) {
      backwards.push_back(static_cast<std::uint8_t>(state >> 8));
      backwards.push_back(static_cast<std::uint8_t>(state));
      state >>= 16;
    }
    state = (state / frequency << kRansBits) + state % frequency + table.start[symbols[k].symbol];
  }
  for (std::size_t k = kRansStates; k-- > 0;) {
    for (const int shift : {24, 16, 8, 0})
      backwards.push_back(static_cast<std::uint8_t>(states[k] >> shift));
  }
  std::reverse(backwards.begin(), backwards.end());
  return backwards;
}

RansDecoder::RansDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
  for (std::uint32_t& state : states_) {
    const std::uint32_t low = next_word();
    state = low | next_word() << 16;
  }
}

void RansDecoder::take(std::span<const RansTable> tables, std::span<const std::uint8_t> contexts,
                       std::span<std::uint8_t> symbols) {
  std::size_t k = 0;
  for (; k < symbols.size() && turn_ != 0; ++k)
    symbols[k] = static_cast<std::uint8_t>(take(tables[contexts[k]]));
  for (; k + kRansStates <= symbols.size(); k += kRansStates) {
    for (std::size_t lane = 0; lane < kRansStates; ++lane)
      symbols[k + lane] =
          static_cast<std::uint8_t>(advance(states_[lane], tables[contexts[k + lane]]));
  }
  for (; k < symbols.size(); ++k) symbols[k] = static_cast<std::uint8_t>(take(tables[contexts[k]]));
}

bool RansDecoder::is_finished() const {
  return at_ == bytes_.size() && std::all_of(states_.begin(), states_.end(),
                                             [](std::uint32_t s) { return s == kLeastState; });
}

}  // namespace plumb::mesh::patch_quadtree
