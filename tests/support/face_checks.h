// Which edges and vertices of a mesh of triangles and quads are not those of a surface.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/stacks/node_mesh.h"

namespace plumb::testing {

/// Counted over the edges and vertices that faces have.
struct FaceCheck {
  int edges = 0;
  int odd_edges = 0;      // not as many faces one way as the other: the mesh is open there
  int crowded_edges = 0;  // more than two faces, or two the same way
  int torn_vertices = 0;  // whose faces are not one fan
  int vertices = 0;
  int rim_edges = 0;  // of one face, where the mesh may end

  bool is_closed() const { return odd_edges == 0; }
  bool is_manifold() const { return odd_edges + crowded_edges + torn_vertices == 0; }
};

/// A face's corner, and what it has of the ring around that: from the next corner to the one
/// before.
struct FarSide {
  std::uint32_t vertex = 0, from = 0, to = 0;
};

/// One way along an edge, from its lower vertex or to it.
struct FaceEdge {
  std::uint32_t low = 0, high = 0;
  bool is_up = false;
};

// Far sides of one vertex are one ring or, where it lies on a rim, one chain.
inline bool is_one_fan(std::span<const FarSide> sides, bool may_be_chain) {
  const auto from = [&](std::uint32_t at) {
    return std::find_if(sides.begin(), sides.end(), [&](const auto& s) { return s.from == at; });
  };
  auto first = std::find_if(sides.begin(), sides.end(), [&](const FarSide& side) {
    return std::none_of(sides.begin(), sides.end(),
                        [&](const FarSide& before) { return before.to == side.from; });
  });
  const bool is_chain = first != sides.end();
  if (!is_chain) first = sides.begin();
  std::size_t steps = 1;
  auto at = first;
  while (at->to != first->from && steps <= sides.size()) {
    const auto next = from(at->to);
    if (next == sides.end()) break;
    at = next;
    ++steps;
  }
  return steps == sides.size() && (may_be_chain || !is_chain);
}

// Runs of equal keys of a sorted vector.
template <class T, class Key, class Visit>
void for_each_run(const std::vector<T>& sorted, const Key& key, const Visit& visit) {
  for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
    while (last < sorted.size() && key(sorted[last]) == key(sorted[first])) ++last;
    visit(std::span(sorted).subspan(first, last - first));
  }
}

/// Faces are counter-clockwise; a triangle's fourth corner is kNoCorner.
///
/// is_rim  of two vertices, in any order: true where the mesh may end at an edge between them
template <class IsRim>
FaceCheck check_faces(std::span<const mesh::stacks::Face> faces, const IsRim& is_rim) {
  std::vector<FarSide> sides;
  std::vector<FaceEdge> edges;
  for (const mesh::stacks::Face& face : faces) {
    const std::size_t corners = face[3] == mesh::stacks::kNoCorner ? 3 : 4;
    for (std::size_t k = 0; k < corners; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % corners];
      sides.push_back({a, b, face[(k + corners - 1) % corners]});
      edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  const auto ends = [](const FaceEdge& e) { return std::uint64_t{e.low} << 32 | e.high; };
  const auto corner = [](const FarSide& side) { return side.vertex; };
  std::sort(edges.begin(), edges.end(), [&](auto& a, auto& b) { return ends(a) < ends(b); });
  std::sort(sides.begin(), sides.end(), [&](auto& a, auto& b) { return corner(a) < corner(b); });
  FaceCheck check;
  for_each_run(edges, ends, [&](std::span<const FaceEdge> run) {
    const auto up = std::count_if(run.begin(), run.end(), [](auto& e) { return e.is_up; });
    const auto down = static_cast<std::ptrdiff_t>(run.size()) - up;
    const bool ends_here = run.size() == 1 && is_rim(run.front().low, run.front().high);
    ++check.edges;
    check.rim_edges += ends_here ? 1 : 0;
    check.odd_edges += up != down && !ends_here ? 1 : 0;
    check.crowded_edges += up > 1 || down > 1 ? 1 : 0;
  });
  for_each_run(sides, corner, [&](std::span<const FarSide> run) {
    ++check.vertices;
    check.torn_vertices += is_one_fan(run, is_rim(run[0].vertex, run[0].vertex)) ? 0 : 1;
  });
  return check;
}

/// Of a mesh that ends nowhere.
inline FaceCheck check_faces(std::span<const mesh::stacks::Face> faces) {
  return check_faces(faces, [](std::uint32_t, std::uint32_t) { return false; });
}

}  // namespace plumb::testing
