#include "mesh/dual_contouring/classification.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/parallel.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr std::size_t kWord = 64;

// 64 comparisons into bytes, which compilers turn into vector instructions, then eight bytes of 0
// or 1 at a time into eight bits: the product moves byte i to bit 56 + i, and no two of its terms
// meet.
std::uint64_t inside_of(const float* density) {
  std::array<std::uint8_t, kWord> flags;
  for (std::size_t k = 0; k < kWord; ++k) flags[k] = is_inside(density[k]) ? 1 : 0;
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < kWord; k += 8) {
    const auto eight = std::bit_cast<std::uint64_t>(
        std::array{flags[k], flags[k + 1], flags[k + 2], flags[k + 3], flags[k + 4], flags[k + 5],
                   flags[k + 6], flags[k + 7]});
    bits |= (eight * 0x0102040810204080ULL) >> 56 << k;
  }
  return bits;
}

}  // namespace

LatticeBox cells_of(const LatticeBox& samples) {
  if (samples.size.x < 2 || samples.size.y < 2 || samples.size.z < 2)
    return {samples.low, glm::ivec3(0)};
  return {samples.low, samples.size - 1};
}

Lattice<CellMask> cell_masks(const Lattice<float>& density) {
  Lattice<CellMask> masks(cells_of(density.box()));
  const LatticeBox cells = masks.box();
  parallel_for(cells.size.z, 1, [&](std::int64_t slice) {
    for (int y = 0; y < cells.size.y; ++y) {
      for (int x = 0; x < cells.size.x; ++x) {
        const glm::ivec3 cell = cells.low + glm::ivec3(x, y, static_cast<int>(slice));
        unsigned mask = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const glm::ivec3 sample = cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
          mask |= (is_inside(density(sample)) ? 1U : 0U) << corner;
        }
        masks(cell) = static_cast<CellMask>(mask);
      }
    }
  });
  return masks;
}

InsideBits::InsideBits(const Lattice<float>& density)
    : samples_(density.box()), cells_(cells_of(density.box())) {
  const auto width = static_cast<std::size_t>(samples_.size.x);
  const auto rows = static_cast<std::size_t>(samples_.size.y);
  words_ = (width + kWord - 1) / kWord + 1;
  bits_.resize(words_ * rows * static_cast<std::size_t>(samples_.size.z));
  parallel_for(samples_.size.z, slices_a_task(width * rows), [&](std::int64_t z) {
    for (std::size_t y = 0; y < rows; ++y) {
      const std::size_t at = static_cast<std::size_t>(z) * rows + y;
      const float* in = density.values().data() + at * width;
      std::uint64_t* out = bits_.data() + at * words_;
      for (std::size_t x = 0; x + kWord <= width; x += kWord) *out++ = inside_of(in + x);
      for (std::size_t x = width / kWord * kWord; x < width; ++x)
        *out |= (is_inside(in[x]) ? std::uint64_t{1} : 0) << x % kWord;
    }
  });
}

std::uint64_t InsideBits::active(int y, int z, std::size_t word) const {
  const std::uint64_t* rows[] = {row(y, z).data() + word, row(y + 1, z).data() + word,
                                 row(y, z + 1).data() + word, row(y + 1, z + 1).data() + word};
  std::uint64_t any = 0, next_any = 0, all = ~std::uint64_t{0}, next_all = all;
  for (const std::uint64_t* bits : rows) {
    any |= bits[0];
    next_any |= bits[1];
    all &= bits[0];
    next_all &= bits[1];
  }
  any |= any >> 1 | next_any << (kWord - 1);
  all &= all >> 1 | next_all << (kWord - 1);
  const auto left = static_cast<std::size_t>(cells_.size.x) -
                    std::min(static_cast<std::size_t>(cells_.size.x), word * kWord);
  const std::uint64_t cells = left >= kWord ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1;
  return any & ~all & cells;
}

CellMask InsideBits::mask(const glm::ivec3& cell) const {
  const auto x = static_cast<std::size_t>(cell.x);
  const auto two = [&](int y, int z) {
    const std::uint64_t* bits = row(y, z).data() + x / kWord;
    const std::size_t at = x % kWord;
    return static_cast<unsigned>(
        (bits[0] >> at | (at == kWord - 1 ? bits[1] << 1 : std::uint64_t{0})) & 3);
  };
  return static_cast<CellMask>(two(cell.y, cell.z) | two(cell.y + 1, cell.z) << 2 |
                               two(cell.y, cell.z + 1) << 4 | two(cell.y + 1, cell.z + 1) << 6);
}

}  // namespace plumb::mesh::dual_contouring
