#include "mesh/dual_contouring/allocation.h"

#include <bit>
#include <limits>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr std::int64_t kRows = 64;  // a task
constexpr int kWord = 64;

// Whether the cell's face_to_split is the same face as its neighbour's beyond it.
bool is_split(const InsideBits& bits, const glm::ivec3& cell, CellMask mask) {
  const int face = face_to_split(mask);
  if (face < 0) return false;
  glm::ivec3 beyond = cell;
  beyond[face / 2] += face % 2 == 1 ? 1 : -1;
  const LatticeBox cells{glm::ivec3(0), bits.cells().size};
  return cells.contains(beyond) && face_to_split(bits.mask(beyond)) == (face ^ 1);
}

// The cells that get vertices, counted from the first of all cells.
struct Drawn {
  const InsideBits& bits;
  LatticeBox box, edges;

  /// The first cell of a row: y fastest.
  glm::ivec3 start(std::int64_t row) const {
    return box.low +
           glm::ivec3(0, static_cast<int>(row % box.size.y), static_cast<int>(row / box.size.y));
  }
  /// Edges from the cell's own corner 0 that get faces: their four cells are among these.
  std::uint32_t quads_at(const glm::ivec3& cell, unsigned mask) const {
    if (!edges.contains(cell)) return 0;
    const bool x = cell.x > box.low.x, y = cell.y > box.low.y, z = cell.z > box.low.z;
    const auto crosses = [&](int axis) { return (mask ^ mask >> (1 << axis)) & 1U; };
    return (y && z ? crosses(0) : 0) + (z && x ? crosses(1) : 0) + (x && y ? crosses(2) : 0);
  }
  /// Calls body(x of bit 0, bits of active cells) along the row of `start`.
  template <class Body>
  void for_words(const glm::ivec3& start, const Body& body) const {
    const int low = box.low.x, high = box.high().x;
    for (int x = low / kWord * kWord; x < high; x += kWord) {
      std::uint64_t active = bits.active(start.y, start.z, static_cast<std::size_t>(x / kWord));
      if (x < low) active &= ~std::uint64_t{0} << (low - x);
      if (high - x < kWord) active &= (std::uint64_t{1} << (high - x)) - 1;
      body(x, active);
    }
  }
};

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
RowCounts fill_row(const Drawn& drawn, Variant variant, const glm::ivec3& start, ActiveCell* out) {
  RowCounts counts;
  drawn.for_words(start, [&](int x, std::uint64_t left) {
    for (; left != 0; left &= left - 1) {
      const glm::ivec3 cell(x + std::countr_zero(left), start.y, start.z);
      const CellMask mask = drawn.bits.mask(cell);
      ActiveCell active{cell.x - drawn.box.low.x, counts.vertices, mask, 1, false};
      if (variant == Variant::Conservative) {
        active.split = is_split(drawn.bits, cell, mask);
        active.vertices = static_cast<std::uint8_t>(manifold_loops(mask, active.split).count);
      }
      counts.vertices += active.vertices;
      counts.quads += drawn.quads_at(cell, mask);
      *out++ = active;
    }
  });
  return counts;
}

std::vector<std::uint32_t> cells_of_rows(const Drawn& drawn, std::int64_t rows) {
  std::vector<std::uint32_t> counts(static_cast<std::size_t>(rows));
  parallel_for(rows, kRows, [&](std::int64_t row) {
    int count = 0;
    drawn.for_words(drawn.start(row),
                    [&](int, std::uint64_t active) { count += std::popcount(active); });
    counts[static_cast<std::size_t>(row)] = static_cast<std::uint32_t>(count);
  });
  return counts;
}

ActiveCells allocate(const Lattice<float>& density, Variant variant, const LatticeBox& cells,
                     const LatticeBox& edges) {
  const InsideBits bits(density);
  const glm::ivec3 low = bits.cells().low;
  const Drawn drawn{bits, {cells.low - low, cells.size}, {edges.low - low, edges.size}};
  ActiveCells active;
  active.variant = variant;
  active.box = cells;
  active.edges = edges;
  const std::int64_t rows = std::int64_t{cells.size.y} * cells.size.z;
  active.first_cell = prefix_sums(cells_of_rows(drawn, rows), "active cells");
  active.cells.resize(active.first_cell.back());
  std::vector<std::uint32_t> vertices(active.rows()), quads(active.rows());
  parallel_for(rows, kRows, [&](std::int64_t row) {
    const auto at = static_cast<std::size_t>(row);
    const RowCounts counts =
        fill_row(drawn, variant, drawn.start(row), active.cells.data() + active.first_cell[at]);
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

}  // namespace

const char* name_of(Variant variant) {
  return variant == Variant::Published ? "published" : "conservative";
}

ActiveCells allocate(const Lattice<float>& density, Variant variant) {
  const LatticeBox cells = cells_of(density.box());
  return allocate(density, variant, cells, cells);
}

ActiveCells allocate(const Lattice<float>& density, Variant variant, const LatticeBox& voxels) {
  const LatticeBox all = cells_of(density.box()), cells{voxels.low - 1, voxels.size + 1};
  require(all.contains(cells.low) && all.contains(cells.high() - 1),
          "the cells of a block must lie in the lattice");
  return allocate(density, variant, cells, voxels);
}

}  // namespace plumb::mesh::dual_contouring
