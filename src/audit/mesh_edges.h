// The edges of a mesh, each with the triangles that share it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace plumb::audit {

/// One side of a triangle.
struct HalfEdge {
  std::uint32_t high;  // the greater of its two vertices; the lesser one is the bucket's
  std::uint32_t triangle;
  bool rising;  // the triangle runs from the lesser vertex to the greater one
};

/// Half-edges sorted by lesser vertex, then greater vertex, then triangle. Sides of no length are
/// left out.
class MeshEdges {
 public:
  explicit MeshEdges(const TriangleMesh& mesh);

  std::uint32_t vertices() const { return static_cast<std::uint32_t>(start_.size()) - 1; }
  std::span<const HalfEdge> from(std::uint32_t low) const {
    return {half_edges_.data() + start_[low], start_[low + 1] - start_[low]};
  }
  /// visit(sides) for each edge from a vertex to a greater one: the half-edges that it consists of.
  template <class Visit>
  void for_each_edge(std::uint32_t low, const Visit& visit) const {
    const std::span<const HalfEdge> all = from(low);
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      while (end < all.size() && all[end].high == all[begin].high) ++end;
      visit(all.subspan(begin, end - begin));
    }
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<HalfEdge> half_edges_;
};

}  // namespace plumb::audit
