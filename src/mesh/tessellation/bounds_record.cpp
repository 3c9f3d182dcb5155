#include "mesh/tessellation/bounds_record.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace plumb::mesh::tessellation {

using patch_quadtree::ByteReader;
using patch_quadtree::Bytes;
using patch_quadtree::GammaReader;
using patch_quadtree::GammaWriter;
using patch_quadtree::RansCounts;
using patch_quadtree::RansDecoder;
using patch_quadtree::RansSymbol;
using patch_quadtree::RansTable;

namespace {

constexpr int kLiveliness = 3;  // of neighbours: alike, less so, not at all
constexpr int kLowBits = 2;
constexpr std::uint32_t kEscape = patch_quadtree::kRansSymbols - 1;

void put_float(float value, Bytes& bytes) {
  const auto word = std::bit_cast<std::uint32_t>(value);
  for (int k = 0; k < 32; k += 8) bytes.push_back(static_cast<std::uint8_t>(word >> k));
}
float take_float(ByteReader& reader) {
  std::uint32_t word = 0;
  for (int k = 0; k < 32; k += 8) word |= std::uint32_t{reader.byte()} << k;
  return std::bit_cast<float>(word);
}

// What a code is likely to be: as the one before it in its own block, changed as it changed in the
// blocks to the left and below.
struct Foretold {
  int code;
  std::size_t context;
};

Foretold foretold(const PatchBounds& bounds, int i, int j, int level) {
  const auto change = [&](int a, int b) {
    return bounds.code(a, b, level) - (level > 0 ? bounds.code(a, b, level - 1) : 0);
  };
  const int base = level > 0 ? bounds.code(i, j, level - 1) : 0;
  const bool has_left = i > 0, has_below = j > 0;
  int left = has_left ? change(i - 1, j) : 0, below = has_below ? change(i, j - 1) : 0;
  if (!has_left) left = below;
  if (!has_below) below = left;
  const int apart = std::abs(left - below);
  const std::size_t liveliness = !has_left && !has_below ? 2 : apart <= 2 ? 0 : apart <= 8 ? 1 : 2;
  const auto context = static_cast<std::size_t>(level) * kLiveliness + liveliness;
  return {std::clamp(base + (left + below) / 2, 0, 255), context};
}

// code(foretold, place of the code) for each, in order.
template <class Code>
void visit(PatchBounds& bounds, const Code& code) {
  if (bounds.is_void()) return;
  std::size_t at = 0;
  for (int j = 0; j < bounds.blocks; ++j) {
    for (int i = 0; i < bounds.blocks; ++i) {
      for (int level = 0; level < bounds.levels; ++level)
        code(foretold(bounds, i, j, level), level, bounds.codes[at++]);
    }
  }
}

std::size_t low_context(int levels, int level) {
  return static_cast<std::size_t>(levels * kLiveliness + level);
}

// put(context, symbol) for both halves of each number, escape(rest) where the upper does not fit.
template <class Put, class Escape>
void visit_symbols(const PatchBounds& bounds, const Put& put, const Escape& escape) {
  PatchBounds copy = bounds;
  visit(copy, [&](const Foretold& expected, int level, std::uint8_t code) {
    const std::uint32_t number = patch_quadtree::folded(int{code} - expected.code);
    const std::uint32_t high = number >> kLowBits;
    put(expected.context, std::min(high, kEscape));
    if (high >= kEscape) escape(high - kEscape + 1);
    put(low_context(bounds.levels, level), number & ((1u << kLowBits) - 1));
  });
}

}  // namespace

std::size_t bound_contexts(int levels) {
  return static_cast<std::size_t>(levels * (kLiveliness + 1));
}

void count_bounds(const PatchBounds& bounds, std::span<RansCounts> counts) {
  visit_symbols(
      bounds, [&](std::size_t context, std::uint32_t symbol) { ++counts[context][symbol]; },
      [](std::uint32_t) {});
}

Bytes encode_bounds(const PatchBounds& bounds, std::span<const RansTable> tables) {
  Bytes bytes;
  bytes.push_back(bounds.is_void() ? 0 : 1);
  put_float(bounds.published_m, bytes);
  if (bounds.is_void()) return bytes;
  put_float(bounds.low_m, bytes);
  put_float(bounds.high_m, bytes);
  std::vector<RansSymbol> symbols;
  GammaWriter escapes;
  visit_symbols(
      bounds,
      [&](std::size_t context, std::uint32_t symbol) {
        symbols.push_back({&tables[context], static_cast<std::uint8_t>(symbol)});
      },
      [&](std::uint32_t rest) { escapes.put(rest); });
  patch_quadtree::put_part(escapes.bytes(), bytes);
  const Bytes coded = patch_quadtree::rans_encode(symbols);
  bytes.insert(bytes.end(), coded.begin(), coded.end());
  return bytes;
}

bool decode_bounds(std::span<const std::uint8_t> bytes, int blocks, int levels,
                   std::span<const RansTable> tables, PatchBounds& bounds) {
  ByteReader reader(bytes);
  const std::uint8_t kind = reader.byte();
  bounds = {};
  bounds.blocks = blocks;
  bounds.levels = levels;
  bounds.published_m = take_float(reader);
  if (kind > 1 || !(bounds.published_m >= 0.0f)) return false;
  if (kind == 0) return !reader.overrun() && reader.rest().empty();
  bounds.low_m = take_float(reader);
  bounds.high_m = take_float(reader);
  if (!std::isfinite(bounds.low_m) || !std::isfinite(bounds.high_m) || bounds.low_m > bounds.high_m)
    return false;
  GammaReader escapes(reader.bytes(reader.number()));
  RansDecoder decoder(reader.rest());
  bounds.codes.assign(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks) *
                          static_cast<std::size_t>(levels),
                      0);
  bool fits = true;
  visit(bounds, [&](const Foretold& expected, int level, std::uint8_t& code) {
    std::uint32_t high = decoder.take(tables[expected.context]);
    if (high == kEscape) high += escapes.take() - 1;
    const std::uint32_t number =
        std::min(high, 1u << 20) << kLowBits |
        std::min(decoder.take(tables[low_context(levels, level)]), (1u << kLowBits) - 1);
    const std::int64_t value = std::int64_t{expected.code} + patch_quadtree::unfolded(number);
    fits = fits && value >= 0 && value <= 255;
    code = static_cast<std::uint8_t>(std::clamp<std::int64_t>(value, 0, 255));
  });
  return fits && decoder.is_finished() && !escapes.overrun() && !reader.overrun();
}

}  // namespace plumb::mesh::tessellation
