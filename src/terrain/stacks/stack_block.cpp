#include "terrain/stacks/stack_block.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/check.h"
#include "terrain/stacks/range_coder.h"

namespace plumb::terrain {
namespace {

// Encoding and decoding are one walk: `code` puts the bit that it is given and gives it back, or
// gives back the one that it reads.
struct Writing {
  static constexpr bool kWrites = true;
  RangeEncoder coder;

  unsigned code(unsigned bit, BitModel& model) {
    coder.put(bit, model);
    return bit;
  }
  bool overrun() const { return false; }
};

struct Reading {
  static constexpr bool kWrites = false;
  RangeDecoder coder;

  unsigned code(unsigned, BitModel& model) { return coder.take(model); }
  bool overrun() const { return coder.overrun(); }
};

// Floats in their order as whole numbers: neighbours differ by one.
std::int32_t ordered(float height_m) {
  const auto bits = std::bit_cast<std::int32_t>(height_m);
  return bits >= 0 ? bits : bits ^ 0x7fffffff;
}
float unordered(std::int32_t number) {
  return std::bit_cast<float>(number >= 0 ? number : number ^ 0x7fffffff);
}

// Numbers by how many bits they have, then the bits below the highest one.
class NumberModels {
 public:
  explicit NumberModels(std::size_t contexts) : widths_(64 * contexts), bits_(33 * 32) {}

  template <class Coin>
  std::uint32_t code(Coin& coin, std::uint32_t number, std::size_t context) {
    const auto given = static_cast<unsigned>(std::bit_width(number));
    unsigned node = 1;
    for (int k = 5; k >= 0; --k)
      node = 2 * node + coin.code(given >> k & 1u, widths_[64 * context + node]);
    const int width = std::min(static_cast<int>(node - 64), 32);
    if (width == 0) return 0;
    std::uint32_t result = 1;
    for (int k = width - 2; k >= 0; --k) {
      const std::size_t at = 32 * static_cast<std::size_t>(width) + static_cast<std::size_t>(k);
      result = result << 1 | coin.code(number >> k & 1u, bits_[at]);
    }
    return result;
  }

 private:
  std::vector<BitModel> widths_, bits_;
};

constexpr std::size_t kWidths = 33;  // contexts of a difference: the width of the one before

// A stack that was coded before, by the places of its layers; or none.
struct Coded {
  std::size_t first = 0, count = 0;
  bool hole = false, is_there = false;
};

// The stack to be written; nothing where one is read.
struct Given {
  StackView stack;
  bool hole = false;
};

template <class Coin>
class StackCoder {
 public:
  StackCoder(Coin& coin, const StackBlockShape& shape, StackRows& rows)
      : coin_(coin), shape_(shape), rows_(rows), materials_(256 * 256) {}

  /// Codes the next stack and appends it to the rows. False where the bytes ended.
  bool code(const Given& given) {
    const std::size_t number = rows_.first_layer.size() - 1,
                      columns = static_cast<std::size_t>(shape_.columns);
    if (number % columns == 0) was_like_west_ = 0;
    const bool has_west = number % columns > 0, has_south = number >= columns;
    if (has_west) west_ = coded(number - 1);
    if (has_south) south_ = coded(number - columns);
    if (has_west && has_south) south_west_ = coded(number - columns - 1);
    west_.is_there = has_west;
    south_.is_there = has_south;
    south_west_.is_there = has_west && has_south;
    code_layers(given);
    for (std::size_t k = 0; rows_.end_m.size() < rows_.material.size() && !coin_.overrun(); ++k)
      rows_.end_m.push_back(code_end(given, k));
    rows_.first_layer.push_back(static_cast<std::uint32_t>(rows_.material.size()));
    return !coin_.overrun();
  }

 private:
  Coded coded(std::size_t number) const {
    const std::size_t first = rows_.first_layer[number];
    return {first, rows_.first_layer[number + 1] - first,
            shape_.has_holes && rows_.holes[number] != 0, true};
  }

  std::span<const Material> materials(const Coded& of) const {
    return std::span(rows_.material).subspan(of.first, of.count);
  }

  bool is_like(const Given& given, const Coded& of) const {
    return given.hole == of.hole && std::ranges::equal(given.stack.material, materials(of));
  }

  // Hole or not, and the materials: those of the west, of the south, or its own.
  void code_layers(const Given& given) {
    const bool alike = west_.is_there && south_.is_there && west_.hole == south_.hole &&
                       std::ranges::equal(materials(west_), materials(south_));
    bool like_west = false, like_south = false;
    if (west_.is_there) {
      like_west = coin_.code(Coin::kWrites && is_like(given, west_) ? 1u : 0u,
                             like_west_[2 * was_like_west_ + (alike ? 1u : 0u)]) != 0;
      was_like_west_ = like_west ? 1 : 0;
    }
    if (!like_west && south_.is_there && !alike)
      like_south = coin_.code(Coin::kWrites && is_like(given, south_) ? 1u : 0u, like_south_) != 0;
    if (like_west || like_south) {
      copy_layers(like_west ? west_ : south_);
    } else {
      code_own_layers(given);
    }
  }

  void copy_layers(const Coded& from) {
    if (shape_.has_holes) rows_.holes.push_back(from.hole ? 1 : 0);
    for (std::size_t k = 0; k < from.count; ++k)
      rows_.material.push_back(rows_.material[from.first + k]);
  }

  void code_own_layers(const Given& given) {
    if (shape_.has_holes)
      rows_.holes.push_back(static_cast<std::uint8_t>(coin_.code(given.hole ? 1u : 0u, hole_)));
    const auto size = static_cast<std::uint32_t>(given.stack.size());
    const std::uint32_t count = counts_.code(coin_, size, 0);
    std::size_t below = 0;
    for (std::uint32_t k = 0; k < count && !coin_.overrun(); ++k) {
      const unsigned material = Coin::kWrites ? given.stack.material[k] : 0u;
      unsigned node = 1;
      for (int bit = 7; bit >= 0; --bit)
        node = 2 * node + coin_.code(material >> bit & 1u, materials_[256 * below + node]);
      below = node - 256;
      rows_.material.push_back(static_cast<Material>(below));
    }
  }

  float code_end(const Given& given, std::size_t k) {
    const auto expected = static_cast<std::uint32_t>(foretold(k));
    const std::uint32_t end =
        Coin::kWrites ? static_cast<std::uint32_t>(ordered(given.stack.end_m[k])) : 0u;
    const std::uint32_t up = end - expected;  // modulo 2^32
    const bool falls = up > 0x7fffffffu;
    const std::uint32_t size = ends_.code(coin_, falls ? 0u - up : up, width_);
    width_ = static_cast<std::size_t>(std::bit_width(size));
    const bool down = size != 0 && coin_.code(falls ? 1u : 0u, falls_) != 0;
    return unordered(static_cast<std::int32_t>(down ? expected - size : expected + size));
  }

  // From the neighbours' layers of the same number and material: the median of west, south and
  // the plane through all three; without any the layer's start.
  std::int32_t foretold(std::size_t k) const {
    const Material material = rows_.material[rows_.end_m.size()];
    const auto fits = [&](const Coded& of) {
      return of.is_there && k < of.count && rows_.material[of.first + k] == material;
    };
    const auto end = [&](const Coded& of) { return ordered(rows_.end_m[of.first + k]); };
    const bool west = fits(west_), south = fits(south_);
    if (!west && !south) return ordered(k == 0 ? shape_.low_m : rows_.end_m.back());
    if (!west || !south || !fits(south_west_)) return end(west ? west_ : south_);
    const std::int64_t a = end(west_), b = end(south_), c = end(south_west_);
    return static_cast<std::int32_t>(std::clamp(a + b - c, std::min(a, b), std::max(a, b)));
  }

  Coin& coin_;
  const StackBlockShape& shape_;
  StackRows& rows_;
  Coded west_, south_, south_west_;
  std::size_t was_like_west_ = 0, width_ = 0;
  std::array<BitModel, 4> like_west_;
  BitModel like_south_, hole_, falls_;
  NumberModels counts_{1}, ends_{kWidths};
  std::vector<BitModel> materials_;  // trees of 8 bits, by the material below
};

}  // namespace

Bytes encode_rows(const StackField& field, int first, int count) {
  require(first >= 0 && count >= 0 && first <= field.rows - count,
          "rows [{}, {}) are not of a field of {}", first, first + count, field.rows);
  const StackBlockShape shape{field.columns, field.low_m, !field.holes.empty()};
  Writing coin;
  StackRows rows;
  StackCoder coder(coin, shape, rows);
  for (int j = first; j < first + count; ++j) {
    for (int i = 0; i < field.columns; ++i) coder.code({field.stack(i, j), field.is_hole(i, j)});
  }
  return coin.coder.finish();
}

// Each stack has a bit at least: whether it is like its neighbour.
std::uint64_t least_bytes_of(std::uint64_t stacks) {
  const std::uint64_t bytes = stacks / RangeDecoder::kMostBitsInAByte;
  return bytes > 4 ? bytes - 4 : 0;
}

bool decode_rows(std::span<const std::uint8_t> bytes, const StackBlockShape& shape, int count,
                 StackRows& rows) {
  rows = StackRows();
  const std::uint64_t stacks =
      static_cast<std::uint64_t>(shape.columns) * static_cast<std::uint64_t>(count);
  Reading coin{RangeDecoder(bytes)};
  StackCoder coder(coin, shape, rows);
  for (std::uint64_t k = 0; k < stacks; ++k) {
    if (!coder.code({})) return false;
  }
  return coin.coder.left() == 0;
}

}  // namespace plumb::terrain
