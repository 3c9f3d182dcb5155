// Which cells the surface passes through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dual_contouring/cell_loops.h"
#include "mesh/dual_contouring/lattice.h"

namespace plumb::mesh::dual_contouring {

/// A sample is inside where its density is above 1/2; exactly 1/2 is outside, and so is NaN.
inline bool is_inside(float density) { return density > 0.5F; }

/// The cells whose eight samples lie in a box of samples; empty if it is less than two wide.
LatticeBox cells_of(const LatticeBox& samples);

/// The corner bits of every cell, dense: the plain stage, which the tests and the hashes look at.
Lattice<CellMask> cell_masks(const Lattice<float>& density);

/// Which samples are inside, one bit each: what finds the few active cells among many.
class InsideBits {
 public:
  explicit InsideBits(const Lattice<float>& density);

  const LatticeBox& samples() const { return samples_; }
  const LatticeBox& cells() const { return cells_; }
  /// Bit x % 64 of word x / 64 is sample low.x + x of a row; y and z count from the box's low. A
  /// last word of zeros follows, so that there is always a next one.
  std::span<const std::uint64_t> row(int y, int z) const {
    return std::span(bits_).subspan(
        (static_cast<std::size_t>(z) * static_cast<std::size_t>(samples_.size.y) +
         static_cast<std::size_t>(y)) *
            words_,
        words_);
  }
  /// Words of active cells of a row of cells, without the one of zeros: bits as above.
  std::size_t active_words() const { return words_ - 1; }
  std::uint64_t active(int y, int z, std::size_t word) const;
  /// The corner bits of a cell, counted from the box's low.
  CellMask mask(const glm::ivec3& cell) const;

 private:
  LatticeBox samples_, cells_;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace plumb::mesh::dual_contouring
