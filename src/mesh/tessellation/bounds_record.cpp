#include "mesh/tessellation/bounds_record.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/little_endian.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::RansCounts;
using patch_quadtree::RansDecoder;
using patch_quadtree::RansSymbol;
using patch_quadtree::RansTable;

namespace {

constexpr int kLiveliness = 3;  // of neighbours: alike, less so, not at all
constexpr int kRatios = 7;      // of what is foretold to the bound of full detail
constexpr int kLowBits = 2;
constexpr std::uint32_t kEscape = patch_quadtree::kRansSymbols - 1;
// Of full detail: upper bits by liveliness, lower bits. Then thinnings, kRatios each.
constexpr std::size_t kLowContext = kLiveliness, kFirstThinned = kLiveliness + 1;

struct Foretold {
  int code;
  std::size_t context;
};

// A block's bound of full detail: as those to the left and below.
Foretold foretold_full(const PatchBounds& bounds, int i, int j) {
  const bool has_left = i > 0, has_below = j > 0;
  int left = has_left ? bounds.code(i - 1, j, 0) : 0,
      below = has_below ? bounds.code(i, j - 1, 0) : 0;
  if (!has_left) left = below;
  if (!has_below) below = left;
  const int apart = std::abs(left - below);
  const std::size_t liveliness = !has_left && !has_below ? 2 : apart <= 2 ? 0 : apart <= 8 ? 1 : 2;
  return {(left + below) / 2, liveliness};
}

// A bound of a thinning: what the patch itself loses by it, and half of what full detail is off.
Foretold foretold_thinned(double distance_m, double full_m, int level, const BoundScale& scale) {
  std::size_t ratio = 0;
  for (double share = 0.5; ratio + 1 < kRatios && distance_m > share * full_m; share *= 2.0)
    ++ratio;
  const auto context = kFirstThinned + static_cast<std::size_t>(level - 1) * kRatios + ratio;
  return {int{scale.code(distance_m + 0.5 * full_m)}, context};
}

template <class Code>
void visit_full(PatchBounds& bounds, const Code& code) {
  if (bounds.is_void()) return;
  const auto levels = static_cast<std::size_t>(bounds.levels);
  std::size_t at = 0;
  for (int j = 0; j < bounds.blocks; ++j) {
    for (int i = 0; i < bounds.blocks; ++i, at += levels)
      code(foretold_full(bounds, i, j), bounds.codes[at]);
  }
}

// A block with a void is of one kind or the other: its thinnings go without saying.
template <class Code>
void visit_thinned(PatchBounds& bounds, const ForetoldBounds& foretold, const Code& code) {
  const auto levels = static_cast<std::size_t>(bounds.levels);
  for (std::size_t at = 0; at < bounds.codes.size(); at += levels) {
    const std::uint8_t full = bounds.codes[at];
    const bool unsaid = full == BoundScale::kNone || foretold.distances_m[at] < 0.0;
    for (std::size_t level = 1; level < levels; ++level) {
      if (unsaid) {
        bounds.codes[at + level] = BoundScale::kNone;
        continue;
      }
      code(foretold_thinned(foretold.distances_m[at + level], foretold.scale.value(full),
                            static_cast<int>(level), foretold.scale),
           bounds.codes[at + level]);
    }
  }
}

// put(context, symbol) for each number's parts, escape(rest) where one does not fit.
template <class Put, class Escape>
void full_symbols(const PatchBounds& bounds, const Put& put, const Escape& escape) {
  PatchBounds copy = bounds;
  visit_full(copy, [&](const Foretold& expected, std::uint8_t code) {
    const std::uint32_t number = folded(int{code} - expected.code);
    const std::uint32_t high = number >> kLowBits;
    put(expected.context, std::min(high, kEscape));
    if (high >= kEscape) escape(high - kEscape + 1);
    put(kLowContext, number & ((1u << kLowBits) - 1));
  });
}
template <class Put, class Escape>
void thinned_symbols(const PatchBounds& bounds, const ForetoldBounds& foretold, const Put& put,
                     const Escape& escape) {
  PatchBounds copy = bounds;
  visit_thinned(copy, foretold, [&](const Foretold& expected, std::uint8_t code) {
    const std::uint32_t number = folded(int{code} - expected.code);
    put(expected.context, std::min(number, kEscape));
    if (number >= kEscape) escape(number - kEscape + 1);
  });
}

// Escapes, counted, and the symbols' code.
class SymbolWriter {
 public:
  explicit SymbolWriter(std::span<const RansTable> tables) : tables_(tables) {}

  void put(std::size_t context, std::uint32_t symbol) {
    symbols_.push_back({&tables_[context], static_cast<std::uint8_t>(symbol)});
  }
  void escape(std::uint32_t rest) { escapes_.put(rest); }
  Bytes take() const {
    Bytes bytes;
    put_part(escapes_.bytes(), bytes);
    const Bytes coded = patch_quadtree::rans_encode(symbols_);
    bytes.insert(bytes.end(), coded.begin(), coded.end());
    return bytes;
  }

 private:
  std::span<const RansTable> tables_;
  std::vector<RansSymbol> symbols_;
  GammaWriter escapes_;
};

class SymbolReader {
 public:
  SymbolReader(std::span<const std::uint8_t> bytes, std::span<const RansTable> tables)
      : tables_(tables),
        reader_(bytes),
        escapes_(reader_.bytes(reader_.number())),
        decoder_(reader_.rest()) {}

  std::uint32_t take(std::size_t context) { return decoder_.take(tables_[context]); }
  std::uint32_t take_with_escape(std::size_t context) {
    const std::uint32_t symbol = take(context);
    return symbol < kEscape ? symbol : std::min(kEscape - 1 + escapes_.take(), 1u << 20);
  }
  bool is_finished() const {
    return decoder_.is_finished() && !escapes_.overrun() && !reader_.overrun();
  }

 private:
  std::span<const RansTable> tables_;
  ByteReader reader_;
  GammaReader escapes_;
  RansDecoder decoder_;
};

// False if the number leads to no code.
bool set_code(int expected, std::uint32_t number, std::uint8_t& code) {
  const std::int64_t value = std::int64_t{expected} + unfolded(number);
  code = static_cast<std::uint8_t>(std::clamp<std::int64_t>(value, 0, 255));
  return value == code;
}

}  // namespace

std::size_t bound_contexts(int levels) {
  return kFirstThinned + static_cast<std::size_t>((levels - 1) * kRatios);
}

void count_bounds(const PatchBounds& bounds, const ForetoldBounds& foretold,
                  std::span<RansCounts> counts) {
  const auto put = [&](std::size_t context, std::uint32_t symbol) { ++counts[context][symbol]; };
  const auto escape = [](std::uint32_t) {};
  full_symbols(bounds, put, escape);
  thinned_symbols(bounds, foretold, put, escape);
}

Bytes encode_bounds(const PatchBounds& bounds, const ForetoldBounds& foretold,
                    std::span<const RansTable> tables) {
  Bytes bytes;
  bytes.push_back(bounds.is_void() ? 0 : 1);
  put(bounds.published_m, bytes);
  if (bounds.is_void()) return bytes;
  put(bounds.low_m, bytes);
  put(bounds.high_m, bytes);
  SymbolWriter full(tables), thinned(tables);
  const auto into = [](SymbolWriter& writer) {
    return [&writer](std::size_t context, std::uint32_t symbol) { writer.put(context, symbol); };
  };
  const auto rest_into = [](SymbolWriter& writer) {
    return [&writer](std::uint32_t rest) { writer.escape(rest); };
  };
  full_symbols(bounds, into(full), rest_into(full));
  thinned_symbols(bounds, foretold, into(thinned), rest_into(thinned));
  put_part(full.take(), bytes);
  const Bytes last = thinned.take();
  bytes.insert(bytes.end(), last.begin(), last.end());
  return bytes;
}

bool decode_bounds(std::span<const std::uint8_t> bytes, int blocks, int levels,
                   std::span<const RansTable> tables, PatchBounds& bounds) {
  ByteReader reader(bytes);
  const std::uint8_t kind = reader.byte();
  bounds = {};
  bounds.blocks = blocks;
  bounds.levels = levels;
  bounds.published_m = take<float>(reader);
  if (kind > 1 || !(bounds.published_m >= 0.0f)) return false;
  if (kind == 0) return !reader.overrun() && reader.rest().empty();
  bounds.low_m = take<float>(reader);
  bounds.high_m = take<float>(reader);
  if (!std::isfinite(bounds.low_m) || !std::isfinite(bounds.high_m) || bounds.low_m > bounds.high_m)
    return false;
  SymbolReader symbols(reader.bytes(reader.number()), tables);
  bounds.codes.assign(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks) *
                          static_cast<std::size_t>(levels),
                      BoundScale::kNone);
  bool fits = !reader.overrun();
  visit_full(bounds, [&](const Foretold& expected, std::uint8_t& code) {
    const std::uint32_t high = symbols.take_with_escape(expected.context) << kLowBits;
    const std::uint32_t low = std::min(symbols.take(kLowContext), (1u << kLowBits) - 1);
    fits = set_code(expected.code, high | low, code) && fits;
  });
  return fits && symbols.is_finished();
}

bool decode_thinned(std::span<const std::uint8_t> bytes, const ForetoldBounds& foretold,
                    std::span<const RansTable> tables, PatchBounds& bounds) {
  if (bounds.is_void()) return true;
  ByteReader reader(bytes);
  reader.bytes(13);  // kind, Err_appr and the range of heights
  reader.bytes(reader.number());
  if (reader.overrun()) return false;
  SymbolReader symbols(reader.rest(), tables);
  bool fits = true;
  visit_thinned(bounds, foretold, [&](const Foretold& expected, std::uint8_t& code) {
    fits = set_code(expected.code, symbols.take_with_escape(expected.context), code) && fits;
  });
  return fits && symbols.is_finished();
}

}  // namespace plumb::mesh::tessellation
