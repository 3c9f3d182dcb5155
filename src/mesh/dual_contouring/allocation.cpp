#include "mesh/dual_contouring/allocation.h"

#include <bit>
#include <limits>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr std::int64_t kRows = 64;  // a task

// Whether the cell's face_to_split is the same face as its neighbour's beyond it.
bool is_split(const InsideBits& bits, const glm::ivec3& cell, CellMask mask) {
  const int face = face_to_split(mask);
  if (face < 0) return false;
  glm::ivec3 beyond = cell;
  beyond[face / 2] += face % 2 == 1 ? 1 : -1;
  const LatticeBox cells{glm::ivec3(0), bits.cells().size};
  return cells.contains(beyond) && face_to_split(bits.mask(beyond)) == (face ^ 1);
}

// Edges from the cell's own corner 0 whose four cells lie in the lattice.
std::uint32_t quads_at(const glm::ivec3& cell, unsigned mask) {
  const bool x = cell.x > 0, y = cell.y > 0, z = cell.z > 0;
  const auto crosses = [&](int axis) { return (mask ^ mask >> (1 << axis)) & 1U; };
  return (y && z ? crosses(0) : 0) + (z && x ? crosses(1) : 0) + (x && y ? crosses(2) : 0);
}

// The place of each row of cells: y fastest.
glm::ivec3 row_start(const LatticeBox& cells, std::int64_t row) {
  return {0, static_cast<int>(row % cells.size.y), static_cast<int>(row / cells.size.y)};
}

// From counts to sums of all counts before; the total comes last.
std::vector<std::uint32_t> prefix_sums(const std::vector<std::uint32_t>& counts, const char* what) {
  std::vector<std::uint32_t> sums(counts.size() + 1);
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    sums[k] = static_cast<std::uint32_t>(sum);
    sum += counts[k];
    require(sum < std::numeric_limits<std::uint32_t>::max(), "a mesh has at most 2^32 - 2 {}",
            what);
  }
  sums.back() = static_cast<std::uint32_t>(sum);
  return sums;
}

// What a row of cells adds to the counts.
struct RowCounts {
  std::uint32_t vertices = 0, quads = 0;
};

// Fills a row's cells; their vertices count from the row's own first.
RowCounts fill_row(const InsideBits& bits, Variant variant, glm::ivec3 cell, ActiveCell* out) {
  RowCounts counts;
  for (std::size_t word = 0; word < bits.active_words(); ++word) {
    for (std::uint64_t left = bits.active(cell.y, cell.z, word); left != 0; left &= left - 1) {
      cell.x = static_cast<int>(word * 64) + std::countr_zero(left);
      const CellMask mask = bits.mask(cell);
      ActiveCell active{cell.x, counts.vertices, mask, 1, false};
      if (variant == Variant::Conservative) {
        active.split = is_split(bits, cell, mask);
        active.vertices = static_cast<std::uint8_t>(manifold_loops(mask, active.split).count);
      }
      counts.vertices += active.vertices;
      counts.quads += quads_at(cell, mask);
      *out++ = active;
    }
  }
  return counts;
}

std::vector<std::uint32_t> cells_of_rows(const InsideBits& bits, std::int64_t rows) {
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(rows));
  parallel_for(rows, kRows, [&](std::int64_t row) {
    const glm::ivec3 start = row_start(bits.cells(), row);
    int count = 0;
    for (std::size_t word = 0; word < bits.active_words(); ++word)
      count += std::popcount(bits.active(start.y, start.z, word));
    counts[static_cast<std::size_t>(row)] = static_cast<std::uint32_t>(count);
  });
  return counts;
}

}  // namespace

const char* name_of(Variant variant) {
  return variant == Variant::Published ? "published" : "conservative";
}

ActiveCells allocate(const Lattice<float>& density, Variant variant) {
  const InsideBits bits(density);
  ActiveCells active;
  active.variant = variant;
  active.box = bits.cells();
  const std::int64_t rows = std::int64_t{active.box.size.y} * active.box.size.z;
  active.first_cell = prefix_sums(cells_of_rows(bits, rows), "active cells");
  active.cells.resize(active.first_cell.back());
  std::vector<std::uint32_t> vertices(active.rows()), quads(active.rows());
  parallel_for(rows, kRows, [&](std::int64_t row) {
    const auto at = static_cast<std::size_t>(row);
    const RowCounts counts = fill_row(bits, variant, row_start(active.box, row),
                                      active.cells.data() + active.first_cell[at]);
    vertices[at] = counts.vertices;
    quads[at] = counts.quads;
  });
  active.first_quad = prefix_sums(quads, "faces");
  const std::vector<std::uint32_t> first_vertex = prefix_sums(vertices, "vertices");
  active.vertices = first_vertex.back();
  parallel_for(rows, kRows, [&](std::int64_t row) {
    const auto at = static_cast<std::size_t>(row);
    for (std::uint32_t k = active.first_cell[at]; k < active.first_cell[at + 1]; ++k)
      active.cells[k].first_vertex += first_vertex[at];
  });
  return active;
}

}  // namespace plumb::mesh::dual_contouring
