#include "mesh/tessellation/block_pieces.h"

#include <algorithm>
#include <bit>

#include "core/check.h"
#include "mesh/tessellation/tessellator.h"

namespace plumb::mesh::tessellation {
namespace {

// Under factors that are powers of two every domain point is a sample.
std::vector<BlockTriangle> triangles_of(int cells, int coarsest, const BlockLevels& levels) {
  const auto factor = [&](int level) {
    return static_cast<float>(cells >> std::min(level, coarsest));
  };
  Factors factors;
  for (std::size_t side = 0; side < 4; ++side) factors.outer[side] = factor(levels.side[side]);
  factors.inner = {factor(levels.inside), factor(levels.inside)};
  const Tessellation drawn = tessellate(Spacing::Integer, factors);
  const unsigned shift = 16u - static_cast<unsigned>(coarsest);
  const auto point = [&](std::uint32_t index) {
    const DomainPoint& p = drawn.points[index];
    return BlockPoint{static_cast<std::uint8_t>(p.u >> shift),
                      static_cast<std::uint8_t>(p.v >> shift)};
  };
  std::vector<BlockTriangle> triangles;
  for (const auto& t : drawn.triangles)
    triangles.push_back({point(t[0]), point(t[1]), point(t[2])});
  return triangles;
}

bool touches_rim(const BlockTriangle& triangle, int cells) {
  return std::any_of(triangle.begin(), triangle.end(), [&](const BlockPoint& p) {
    return p.i == 0 || p.j == 0 || p.i == cells || p.j == cells;
  });
}

// Of a triangle of the ring: the strips meet along the block's own diagonals.
std::size_t side_of(const BlockTriangle& triangle, int cells) {
  int i = 0, j = 0;  // three times the centre
  for (const BlockPoint& p : triangle) {
    i += p.i;
    j += p.j;
  }
  const std::array<int, 4> distance{i, j, 3 * cells - i, 3 * cells - j};
  return static_cast<std::size_t>(std::min_element(distance.begin(), distance.end()) -
                                  distance.begin());
}

}  // namespace

BlockPieces::BlockPieces(int block_cells)
    : block_cells_(block_cells), coarsest_(std::countr_zero(static_cast<unsigned>(block_cells))) {
  require(block_cells >= 8 && block_cells <= 64 &&
              std::has_single_bit(static_cast<unsigned>(block_cells)),
          "block_cells must be a power of two from 8 to 64, got {}", block_cells);
  const auto uniform = [](int inside, int along) {
    const auto side = static_cast<std::uint8_t>(along);
    return BlockLevels{static_cast<std::uint8_t>(inside), {side, side, side, side}};
  };
  for (int inside = 0; inside < coarsest_; ++inside) {
    std::vector<std::vector<BlockTriangle>> strips(4 * static_cast<std::size_t>(coarsest_ + 1));
    for (int along = 0; along <= coarsest_; ++along) {
      const auto drawn = triangles_of(block_cells, coarsest_, uniform(inside, along));
      for (const BlockTriangle& triangle : drawn) {
        if (touches_rim(triangle, block_cells))
          strips[side_of(triangle, block_cells) * static_cast<std::size_t>(coarsest_ + 1) +
                 static_cast<std::size_t>(along)]
              .push_back(triangle);
      }
    }
    std::vector<BlockTriangle> interior;
    for (const BlockTriangle& triangle :
         triangles_of(block_cells, coarsest_, uniform(inside, inside))) {
      if (!touches_rim(triangle, block_cells)) interior.push_back(triangle);
    }
    interior_.push_back(std::move(interior));
    strips_.insert(strips_.end(), strips.begin(), strips.end());
  }
  whole_ = triangles_of(block_cells, coarsest_, uniform(coarsest_, coarsest_));
}

}  // namespace plumb::mesh::tessellation
