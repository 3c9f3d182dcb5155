#include "audit/mesh_examination.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

struct OpenEdge {
  std::uint32_t low, high, triangle;
};

class Examination {
 public:
  Examination(const SheetRules& rules, const DrawnSurface& surface, const MeshEdges& edges,
              int most_listed)
      : rules_(rules),
        surface_(surface),
        mesh_(*surface.mesh),
        shift_(mesh_.origin_m - rules.origin_m()),
        edges_(edges),
        most_listed_(most_listed) {}

  Topology run() {
    result_.triangles = static_cast<std::int64_t>(mesh_.triangles.size());
    result_.vertices = static_cast<std::int64_t>(mesh_.vertices_m.size());
    examine_triangles();
    examine_edges();
    examine_vertices();
    find_t_junctions();
    return std::move(result_);
  }

 private:
  glm::dvec3 position(std::uint32_t vertex) const { return mesh_.vertices_m[vertex] + shift_; }

  void list(const char* kind, const glm::dvec3& at, std::uint32_t triangle) {
    if (++listed_[kind] > most_listed_) return;
    result_.listed.push_back(
        {kind, at, triangle, triangle == kNoPrimitive ? -1 : patch_of(surface_, triangle)});
  }

  enum class Shape : char { Sound, Degenerate, Folded };

  Shape shape_of(std::uint32_t t) const {
    const Triangle& corners = mesh_.triangles[t];
    const glm::dvec3 a = position(corners[0]), b = position(corners[1]), c = position(corners[2]);
    const glm::dvec3 normal = area_normal(a, b, c);
    if (normal == glm::dvec3(0.0)) return Shape::Degenerate;
    return rules_.is_folded(normal, a, b, c) ? Shape::Folded : Shape::Sound;
  }

  void examine_triangles() {
    std::vector<Shape> shapes(mesh_.triangles.size());
    parallel_for(static_cast<std::int64_t>(shapes.size()), 1 << 14, [&](std::int64_t t) {
      shapes[static_cast<std::size_t>(t)] = shape_of(static_cast<std::uint32_t>(t));
    });
    for (std::uint32_t t = 0; t < shapes.size(); ++t) {
      if (shapes[t] == Shape::Sound) continue;
      const Triangle& corners = mesh_.triangles[t];
      if (shapes[t] == Shape::Degenerate) {
        ++result_.degenerate_triangles;
        list("degenerate", position(corners[0]), t);
      } else {
        ++result_.folded_triangles;
        list("folded", (position(corners[0]) + position(corners[1]) + position(corners[2])) / 3.0,
             t);
      }
    }
  }

  // What the edges from a run of vertices are like, in their order.
  struct EdgeRun {
    std::int64_t boundary = 0;
    int lod_jump = 0;
    std::vector<OpenEdge> open, non_manifold, folded;
  };

  static EdgeRun joined(EdgeRun a, const EdgeRun& b) {
    a.boundary += b.boundary;
    a.lod_jump = std::max(a.lod_jump, b.lod_jump);
    a.open.insert(a.open.end(), b.open.begin(), b.open.end());
    a.non_manifold.insert(a.non_manifold.end(), b.non_manifold.begin(), b.non_manifold.end());
    a.folded.insert(a.folded.end(), b.folded.begin(), b.folded.end());
    return a;
  }

  void examine_edges() {
    const EdgeRun all = parallel_ordered_reduce(
        edges_.vertices(), 1 << 14, EdgeRun{},
        [&](std::int64_t begin, std::int64_t end, EdgeRun run) {
          for (std::int64_t low = begin; low < end; ++low)
            examine_edges_of(static_cast<std::uint32_t>(low), run);
          return run;
        },
        joined);
    result_.boundary_edges = all.boundary;
    result_.largest_lod_jump = all.lod_jump;
    result_.open_edges = static_cast<std::int64_t>(all.open.size());
    result_.non_manifold_edges = static_cast<std::int64_t>(all.non_manifold.size());
    const auto list_all = [&](const char* kind, const std::vector<OpenEdge>& edges) {
      for (const OpenEdge& edge : edges)
        list(kind, 0.5 * (position(edge.low) + position(edge.high)), edge.triangle);
    };
    list_all("open edge", all.open);
    list_all("non-manifold edge", all.non_manifold);
    result_.folded_triangles += static_cast<std::int64_t>(all.folded.size());
    list_all("folded", all.folded);
    open_ = all.open;
  }

  void examine_edges_of(std::uint32_t low, EdgeRun& run) const {
    edges_.for_each_edge(low, [&](std::span<const HalfEdge> sides) {
      const OpenEdge edge{low, sides[0].high, sides[0].triangle};
      if (sides.size() == 1) {
        ++run.boundary;
        if (rules_.is_open(position(low), position(edge.high))) run.open.push_back(edge);
      } else if (sides.size() > 2 || sides[0].rising == sides[1].rising) {
        run.non_manifold.push_back(edge);
      } else {
        if (rules_.folds_at_edges() &&
            rules_.is_folded_at_edge(normal(sides[0].triangle), normal(sides[1].triangle)))
          run.folded.push_back(edge);
        run.lod_jump = std::max(run.lod_jump, jump(sides[0].triangle, sides[1].triangle));
      }
    });
  }

  int jump(std::uint32_t a, std::uint32_t b) const {
    if (surface_.triangle_lod.empty()) return 0;
    return std::abs(surface_.triangle_lod[a] - surface_.triangle_lod[b]);
  }

  glm::dvec3 normal(std::uint32_t t) const {
    const Triangle& c = mesh_.triangles[t];
    return area_normal(position(c[0]), position(c[1]), position(c[2]));
  }

  // A vertex is manifold if its triangles, joined where they share an edge at it, are one fan.
  void examine_vertices() {
    std::vector<std::uint32_t> start(mesh_.vertices_m.size() + 1, 0);
    for (const Triangle& t : mesh_.triangles) {
      for (const std::uint32_t v : t) ++start[v + 1];
    }
    for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
    std::vector<std::uint32_t> around(start.back()), next(start.begin(), start.end() - 1);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) around[next[v]++] = t;
    }
    std::vector<char> broken(mesh_.vertices_m.size(), 0);
    parallel_for(static_cast<std::int64_t>(broken.size()), 4096, [&](std::int64_t k) {
      const auto v = static_cast<std::size_t>(k);
      broken[v] = fans_at(static_cast<std::uint32_t>(v),
                          {around.data() + start[v], start[v + 1] - start[v]}) > 1;
    });
    for (std::uint32_t v = 0; v < broken.size(); ++v) {
      if (broken[v] == 0 || rules_.may_pinch(position(v))) continue;
      ++result_.non_manifold_vertices;
      list("non-manifold vertex", position(v), around[start[v]]);
    }
  }

  // Fans of triangles around a vertex: each triangle joins its neighbours by their two other
  // corners.
  int fans_at(std::uint32_t v, std::span<const std::uint32_t> triangles) const {
    constexpr std::size_t kFew =
        16;  // vertices of more triangles are rare, and take memory of their own
    using Rim = std::pair<std::uint32_t, std::uint32_t>;
    const std::size_t count = triangles.size();
    std::array<Rim, kFew> few;
    std::vector<Rim> many(count > kFew ? count : 0);
    const std::span<Rim> rims =
        count > kFew ? std::span<Rim>(many) : std::span<Rim>(few).first(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Triangle& c = mesh_.triangles[triangles[k]];
      const std::size_t own = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      rims[k] = {c[(own + 1) % 3], c[(own + 2) % 3]};
    }
    // The fan at hand is [begin, end); what touches a triangle of it is moved to its end.
    int fans = 0;
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
      ++fans;
      end = begin + 1;
      for (std::size_t grown = begin; grown < end; ++grown) {
        const Rim rim = rims[grown];
        for (std::size_t other = end; other < count; ++other) {
          const auto [p, q] = rims[other];
          if (p != rim.first && p != rim.second && q != rim.first && q != rim.second) continue;
          std::swap(rims[other], rims[end++]);
        }
      }
    }
    return fans;
  }

  // Vertices of open edges that lie in the inside of another open edge. They come few, or the mesh
  // is a ruin anyway.
  void find_t_junctions() {
    constexpr std::size_t kMostEdges = 20'000;
    std::vector<std::pair<glm::dvec3, std::uint32_t>> ends;
    for (const OpenEdge& edge : open_) {
      for (const std::uint32_t v : {edge.low, edge.high})
        ends.emplace_back(rules_.place(position(v)), v);
    }
    std::sort(ends.begin(), ends.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first.x, a.first.y, a.first.z, a.second) <
             std::tie(b.first.x, b.first.y, b.first.z, b.second);
    });
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const double near = rules_.beside_m();
    std::vector<std::uint32_t> found;
    for (std::size_t k = 0; k < std::min(open_.size(), kMostEdges); ++k) {
      const OpenEdge& edge = open_[k];
      const glm::dvec3 a = rules_.place(position(edge.low)), b = rules_.place(position(edge.high)),
                       d = b - a;
      const double length = std::sqrt(glm::dot(d, d));
      const auto first =
          std::lower_bound(ends.begin(), ends.end(), std::min(a.x, b.x) - near,
                           [](const auto& end, double x) { return end.first.x < x; });
      for (auto end = first; end != ends.end() && end->first.x <= std::max(a.x, b.x) + near;
           ++end) {
        if (end->second == edge.low || end->second == edge.high) continue;
        const glm::dvec3 p = end->first - a, crossed = glm::cross(p, d);
        const double along = glm::dot(p, d) / length,
                     across = std::sqrt(glm::dot(crossed, crossed)) / length;
        if (across > near || along <= near || along >= length - near) continue;
        found.push_back(end->second);
        list("T-junction", position(end->second), edge.triangle);
      }
    }
    std::sort(found.begin(), found.end());
    result_.t_junctions = std::unique(found.begin(), found.end()) - found.begin();
  }

  const SheetRules& rules_;
  const DrawnSurface& surface_;
  const TriangleMesh& mesh_;
  glm::dvec3 shift_;
  const MeshEdges& edges_;
  int most_listed_;
  Topology result_;
  std::map<std::string, int> listed_;
  std::vector<OpenEdge> open_;
};

}  // namespace

Topology examined(const SheetRules& rules, const DrawnSurface& surface, const MeshEdges& edges,
                  int most_listed) {
  return Examination(rules, surface, edges, most_listed).run();
}

}  // namespace plumb::audit
