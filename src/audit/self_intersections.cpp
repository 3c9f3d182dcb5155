#include "audit/self_intersections.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "core/box.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

using Corners = std::array<glm::dvec3, 3>;

Corners corners_of(const TriangleMesh& mesh, std::uint32_t t) {
  const Triangle& c = mesh.triangles[t];
  return {mesh.vertices_m[c[0]], mesh.vertices_m[c[1]], mesh.vertices_m[c[2]]};
}

Box box_of(const Corners& corners) {
  Box box;
  for (const glm::dvec3& corner : corners) box.add(corner);
  return box;
}

// Six times the volume of a tetrahedron, with its sign.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

bool have_a_corner_in_common(const Corners& a, const Corners& b) {
  for (const glm::dvec3& p : a) {
    for (const glm::dvec3& q : b) {
      if (p == q) return true;
    }
  }
  return false;
}

bool passes_through(const glm::dvec3& p, const glm::dvec3& q, const Corners& t) {
  const double at_p = volume(t[0], t[1], t[2], p), at_q = volume(t[0], t[1], t[2], q);
  if (!((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0))) return false;
  const double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]),
               c = volume(p, q, t[2], t[0]);
  return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

bool intersect(const Corners& a, const Corners& b) {
  if (have_a_corner_in_common(a, b)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (passes_through(a[k], a[(k + 1) % 3], b) || passes_through(b[k], b[(k + 1) % 3], a))
      return true;
  }
  return false;
}

// Cubes over the mesh's box, named by one number.
class BoxGrid {
 public:
  struct Entry {
    std::uint64_t cell;
    std::uint32_t triangle;
    friend bool operator<(const Entry& a, const Entry& b) {
      return std::tie(a.cell, a.triangle) < std::tie(b.cell, b.triangle);
    }
  };

  BoxGrid(const Box& all, double edge_m) : low_(all.low), edge_m_(edge_m) {
    across_ = static_cast<std::uint64_t>(place(all.high, 0)) + 1;
    up_ = static_cast<std::uint64_t>(place(all.high, 1)) + 1;
  }

  std::uint64_t cell(const glm::dvec3& at) const {
    return name(place(at, 0), place(at, 1), place(at, 2));
  }
  double cells(const Box& box) const {
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      count *= static_cast<double>(place(box.high, axis) - place(box.low, axis) + 1);
    return count;
  }
  void add(const Box& box, std::uint32_t triangle, std::vector<Entry>& entries) const {
    for (std::int64_t z = place(box.low, 2); z <= place(box.high, 2); ++z) {
      for (std::int64_t y = place(box.low, 1); y <= place(box.high, 1); ++y) {
        for (std::int64_t x = place(box.low, 0); x <= place(box.high, 0); ++x)
          entries.push_back({name(x, y, z), triangle});
      }
    }
  }

 private:
  std::int64_t place(const glm::dvec3& at, int axis) const {
    return static_cast<std::int64_t>((at[axis] - low_[axis]) / edge_m_);
  }
  std::uint64_t name(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return (static_cast<std::uint64_t>(z) * up_ + static_cast<std::uint64_t>(y)) * across_ +
           static_cast<std::uint64_t>(x);
  }

  glm::dvec3 low_;
  double edge_m_;
  std::uint64_t across_ = 1, up_ = 1;
};

// Twice the triangles' mean length, and coarser where that would be too many places. No grid has
// more than 2^20 cells along an axis, so that names stay below 2^60.
double cell_edge_m(const std::vector<Box>& boxes, const Box& all) {
  double sum = 0.0;
  for (const Box& box : boxes) {
    const glm::dvec3 size = box.high - box.low;
    sum += std::max({size.x, size.y, size.z});
  }
  const glm::dvec3 extent = all.high - all.low;
  double edge_m = std::max(2.0 * sum / static_cast<double>(boxes.size()),
                           0x1p-20 * std::max({extent.x, extent.y, extent.z}));
  const double most = 8.0 * static_cast<double>(boxes.size());
  for (;; edge_m *= 2.0) {
    const BoxGrid grid(all, edge_m);
    double entries = 0.0;
    for (const Box& box : boxes) entries += grid.cells(box);
    if (entries <= most) return edge_m;
  }
}

bool overlap(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return false;
  }
  return true;
}

}  // namespace

std::int64_t self_intersections_of(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return 0;
  std::vector<Box> boxes(mesh.triangles.size());
  parallel_for(static_cast<std::int64_t>(boxes.size()), 1 << 14, [&](std::int64_t t) {
    boxes[static_cast<std::size_t>(t)] = box_of(corners_of(mesh, static_cast<std::uint32_t>(t)));
  });
  Box all;
  for (const Box& box : boxes) {
    all.add(box.low);
    all.add(box.high);
  }
  if (all.low == all.high) return 0;
  const BoxGrid grid(all, cell_edge_m(boxes, all));
  std::vector<BoxGrid::Entry> entries;
  for (std::uint32_t t = 0; t < boxes.size(); ++t) grid.add(boxes[t], t, entries);
  std::sort(entries.begin(), entries.end());
  // Each entry with those after it in its cell; a pair counts in the lowest cell that both share.
  const auto pairs_of = [&](std::size_t k) {
    std::int64_t found = 0;
    const Box& own = boxes[entries[k].triangle];
    for (std::size_t other = k + 1;
         other < entries.size() && entries[other].cell == entries[k].cell; ++other) {
      const Box& box = boxes[entries[other].triangle];
      if (!overlap(own, box) || grid.cell(glm::max(own.low, box.low)) != entries[k].cell) continue;
      found += intersect(corners_of(mesh, entries[k].triangle),
                         corners_of(mesh, entries[other].triangle));
    }
    return found;
  };
  return parallel_ordered_reduce(
      static_cast<std::int64_t>(entries.size()), 1 << 12, std::int64_t{0},
      [&](std::int64_t begin, std::int64_t end, std::int64_t sum) {
        for (std::int64_t k = begin; k < end; ++k) sum += pairs_of(static_cast<std::size_t>(k));
        return sum;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
}

}  // namespace plumb::audit
