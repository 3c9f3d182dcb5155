// A block of a patch as the tessellator draws it, in pieces that do not depend on each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace plumb::mesh::tessellation {

/// Cells along a block of the full-detail surface, whose diagonals are those of `blocks:8`.
inline constexpr int kTruthBlockCells = 8;

/// A sample of a block, (i, j) in [0, block_cells] from its south-west corner.
struct BlockPoint {
  std::uint8_t i = 0, j = 0;

  friend auto operator<=>(const BlockPoint&, const BlockPoint&) = default;
};

/// Counter-clockwise seen from above.
using BlockTriangle = std::array<BlockPoint, 3>;

/// Sides of a block in the order of a patch's outer tessellation factors.
enum Side : std::size_t { West = 0, South = 1, East = 2, North = 3 };

/// How far a block is thinned: factor block_cells / 2^d, inside and along each side.
struct BlockLevels {
  std::uint8_t inside = 0;
  std::array<std::uint8_t, 4> side{};

  friend bool operator==(const BlockLevels&, const BlockLevels&) = default;
};

/// The triangles of a block under factors that are powers of two, all vertices on samples. A ring
/// of four strips, each of which depends on the inner factor and its own side's, and what is inside
/// them, which depends on the inner factor alone; inside 1 beside any other factor is 2; factors 1
/// all round are two triangles.
class BlockPieces {
 public:
  /// Throws std::invalid_argument unless block_cells is a power of two from 8 to 64, the most that
  /// hardware cuts an edge into.
  explicit BlockPieces(int block_cells);

  int block_cells() const { return block_cells_; }
  /// How far a block can be thinned: factor block_cells / 2^coarsest() is 1.
  int coarsest() const { return coarsest_; }

  /// Calls visit(triangles) for every piece that a block of these levels is made of.
  template <class Visit>
  void for_each_piece(const BlockLevels& levels, const Visit& visit) const {
    if (is_whole(levels)) return visit(whole_);
    const int inside = drawn_inside(levels.inside);
    visit(interior(inside));
    for (std::size_t side = 0; side < 4; ++side) visit(strip(inside, side, levels.side[side]));
  }

  const std::vector<BlockTriangle>& interior(int inside) const {
    return interior_[static_cast<std::size_t>(inside)];
  }
  const std::vector<BlockTriangle>& strip(int inside, std::size_t side, int along) const {
    return strips_[(static_cast<std::size_t>(inside) * 4 + side) *
                       static_cast<std::size_t>(coarsest_ + 1) +
                   static_cast<std::size_t>(along)];
  }
  const std::vector<BlockTriangle>& whole() const { return whole_; }
  /// An inside of one segment is drawn as two.
  int drawn_inside(int inside) const { return inside < coarsest_ ? inside : coarsest_ - 1; }
  bool is_whole(const BlockLevels& levels) const {
    return levels.inside == coarsest_ &&
           levels.side == std::array<std::uint8_t, 4>{levels.inside, levels.inside, levels.inside,
                                                      levels.inside};
  }

 private:
  int block_cells_, coarsest_;
  std::vector<std::vector<BlockTriangle>> interior_, strips_;
  std::vector<BlockTriangle> whole_;
};

}  // namespace plumb::mesh::tessellation
