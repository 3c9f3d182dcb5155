#include "mesh/dual_contouring/faces.h"

#include <cstddef>

#include "core/parallel.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr std::int64_t kRows = 64;  // a task

std::uint32_t vertex_at(const ActiveCells& active, const ActiveCell& cell, int edge) {
  if (cell.vertices == 1) return cell.first_vertex;
  return cell.first_vertex +
         static_cast<std::uint32_t>(active.loops(cell).of_edge[static_cast<std::size_t>(edge)]);
}

// Walks along a row of active cells beside another one.
class Beside {
 public:
  Beside(const ActiveCells& active, std::size_t row)
      : at_(active.cells.data() + active.first_cell[row]),
        end_(active.cells.data() + active.first_cell[row + 1]) {}
  Beside() = default;

  void go_to(std::int32_t x) {
    while (at_ != end_ && at_->x < x) ++at_;
  }
  /// Of the place that go_to named, and of the one before: both must be active.
  const ActiveCell& here() const { return *at_; }
  const ActiveCell& before() const { return at_[-1]; }

 private:
  const ActiveCell *at_ = nullptr, *end_ = nullptr;
};

// The faces of a row's edges, from its place in the order on.
class RowFaces {
 public:
  RowFaces(const ActiveCells& active, std::size_t row, Quad* out)
      : active_(active), row_(row), out_(out) {
    const auto width = static_cast<std::size_t>(active.box.size.y);
    has_y_ = row % width > 0;
    has_z_ = row >= width;
    if (has_y_) minus_y_ = Beside(active, row - 1);
    if (has_z_) minus_z_ = Beside(active, row - width);
    if (has_y_ && has_z_) minus_yz_ = Beside(active, row - width - 1);
  }

  void write() {
    for (std::uint32_t k = active_.first_cell[row_]; k < active_.first_cell[row_ + 1]; ++k) {
      const ActiveCell& cell = active_.cells[k];
      if (!active_.edges.contains(active_.place(row_, cell))) continue;
      minus_y_.go_to(cell.x);
      minus_z_.go_to(cell.x);
      minus_yz_.go_to(cell.x);
      const auto differs = [&](int axis) {
        return ((cell.mask ^ cell.mask >> (1 << axis)) & 1) != 0;
      };
      const auto before = [&]() -> const ActiveCell& { return active_.cells[k - 1]; };
      if (has_y_ && has_z_ && differs(0))
        put<0>(minus_yz_.here(), minus_z_.here(), cell, minus_y_.here());
      if (has_z_ && cell.x > 0 && differs(1))
        put<1>(minus_z_.before(), before(), cell, minus_z_.here());
      if (has_y_ && cell.x > 0 && differs(2))
        put<2>(minus_y_.before(), minus_y_.here(), cell, before());
    }
  }

 private:
  // Cells p - a - b, p - b, p, p - a: counter-clockwise seen from p + axis.
  template <int axis>
  void put(const ActiveCell& minus_ab, const ActiveCell& minus_b, const ActiveCell& p,
           const ActiveCell& minus_a) {
    constexpr int a = 1 << (axis + 1) % 3, b = 1 << (axis + 2) % 3;
    const std::uint32_t first = vertex_at(active_, minus_ab, edge_at(a | b, axis));
    const std::uint32_t second = vertex_at(active_, minus_b, edge_at(b, axis));
    const std::uint32_t third = vertex_at(active_, p, edge_at(0, axis));
    const std::uint32_t fourth = vertex_at(active_, minus_a, edge_at(a, axis));
    const bool inside = (p.mask & 1) != 0;
    *out_++ = {first, inside ? second : fourth, third, inside ? fourth : second};
  }

  const ActiveCells& active_;
  std::size_t row_;
  Quad* out_;
  bool has_y_ = false, has_z_ = false;
  Beside minus_y_, minus_z_, minus_yz_;
};

}  // namespace

std::vector<Quad> quads_of(const ActiveCells& active) {
  std::vector<Quad> quads(active.first_quad.back());
  parallel_for(static_cast<std::int64_t>(active.rows()), kRows, [&](std::int64_t row) {
    const auto at = static_cast<std::size_t>(row);
    RowFaces(active, at, quads.data() + active.first_quad[at]).write();
  });
  return quads;
}

}  // namespace plumb::mesh::dual_contouring
