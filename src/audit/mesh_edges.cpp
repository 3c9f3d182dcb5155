#include "audit/mesh_edges.h"

#include <algorithm>
#include <tuple>

#include "core/memory.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

template <class Visit>
void for_each_side(const TriangleMesh& mesh, const Visit& visit) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corners = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = corners[k], q = corners[(k + 1) % 3];
      if (p != q)
        visit(std::min(p, q), HalfEdge{std::max(p, q), static_cast<std::uint32_t>(t), p < q});
    }
  }
}

}  // namespace

MeshEdges::MeshEdges(const TriangleMesh& mesh) {
  require_memory(static_cast<std::int64_t>(mesh.triangles.size() * 3 * sizeof(HalfEdge) +
                                           mesh.vertices_m.size() * sizeof(std::size_t)),
                 "the audit of a mesh's topology");
  start_.assign(mesh.vertices_m.size() + 1, 0);
  for_each_side(mesh, [&](std::uint32_t low, const HalfEdge&) { ++start_[low + 1]; });
  for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  half_edges_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for_each_side(mesh,
                [&](std::uint32_t low, const HalfEdge& edge) { half_edges_[next[low]++] = edge; });
  parallel_for(vertices(), 4096, [&](std::int64_t v) {
    std::sort(
        half_edges_.begin() + static_cast<std::ptrdiff_t>(start_[static_cast<std::size_t>(v)]),
        half_edges_.begin() + static_cast<std::ptrdiff_t>(start_[static_cast<std::size_t>(v) + 1]),
        [](const HalfEdge& a, const HalfEdge& b) {
          return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
        });
  });
}

}  // namespace plumb::audit
