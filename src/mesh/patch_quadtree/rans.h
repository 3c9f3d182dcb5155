// Range asymmetric numeral systems: symbols of stated frequencies as bits, several at a time.
// Source: [Duda 2013]; states of 32 bits, renormalised by 16.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plumb::mesh::patch_quadtree {

inline constexpr int kRansSymbols = 16;
inline constexpr int kRansBits = 12;
inline constexpr std::uint32_t kRansTotal = 1u << kRansBits;
/// Symbols k, k + 4, k + 8, ... share a state, so that one need not wait for the one before.
inline constexpr int kRansStates = 4;

/// Frequencies of the symbols, each at least 1, kRansTotal in all.
using RansFrequencies = std::array<std::uint16_t, kRansSymbols>;

/// The frequencies nearest to counts; every symbol can be coded.
RansFrequencies rans_frequencies(std::span<const std::uint64_t> counts);

/// What an encoder and a decoder need to know of one context.
struct RansTable {
  RansFrequencies frequency{};
  std::array<std::uint16_t, kRansSymbols + 1> start{};
  /// Of each place in [0, kRansTotal): symbol, its frequency and how far inside it the place lies:
  /// bits 0 to 3, 4 to 16 (less one), 17 to 28.
  std::vector<std::uint32_t> slot;

  explicit RansTable(const RansFrequencies& frequencies);
};

/// A symbol and the table of its context.
struct RansSymbol {
  const RansTable* table;
  std::uint8_t symbol;
};

std::vector<std::uint8_t> rans_encode(std::span<const RansSymbol> symbols);

/// Takes symbols in the order in which they were encoded.
class RansDecoder {
 public:
  explicit RansDecoder(std::span<const std::uint8_t> bytes);

  std::uint32_t take(const RansTable& table) {
    std::uint32_t& state = states_[turn_];
    turn_ = (turn_ + 1) % kRansStates;
    return advance(state, table);
  }
  /// symbols[k] by tables[contexts[k]], for all of them.
  void take(std::span<const RansTable> tables, std::span<const std::uint8_t> contexts,
            std::span<std::uint8_t> symbols);
  /// True if every byte was used, none beyond, and the states are as they began: what was decoded
  /// is what was encoded.
  bool is_finished() const;

 private:
  std::uint32_t advance(std::uint32_t& state, const RansTable& table) {
    const std::uint32_t slot = table.slot[state & (kRansTotal - 1)];
    state = ((slot >> 4 & 0x1fffu) + 1) * (state >> kRansBits) + (slot >> 17);
    if (state < (1u << 16)) state = state << 16 | next_word();
    return slot & 15u;
  }
  std::uint32_t next_word() {
    std::uint32_t word = 0;
    if (at_ + 2 <= bytes_.size())
      word = static_cast<std::uint32_t>(bytes_[at_] | bytes_[at_ + 1] << 8);
    at_ += 2;
    return word;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0, turn_ = 0;
  std::array<std::uint32_t, kRansStates> states_{};
};

}  // namespace plumb::mesh::patch_quadtree
