// Which vertices a conforming triangulation needs so that no triangle is coarser than allowed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/grid.h"
#include "mesh/restricted_quadtree/bintree.h"
#include "mesh/restricted_quadtree/triangle_error.h"

namespace plumb::mesh::restricted_quadtree {

/// Enabled vertices of a restricted quadtree over a terrain.
///
/// The smallest set that is closed (a vertex needs the right-angle corners of its two triangles:
/// the vertices that split their parents) and in which no triangle is left whole that must be
/// split. It exists and is unique: a triangle that is there in the set found so far is there in
/// every closed set that holds it, so its base vertex cannot be left out; hence the order in which
/// triangles are looked at does not matter, and the result is a property of the terrain and the
/// rule. Departure from [Intel sample 2012, algorithm 2], which decides bottom-up and enables a
/// vertex whose error is too large even where the coarser triangle above it is good enough: see
/// docs/algorithms/restricted-quadtree.md.
class Refinement {
 public:
  Refinement(const terrain::Heightfield& field, const TriangleErrors& errors)
      : errors_(errors), enabled_(field.columns(), field.rows(), 0) {}

  /// must_split(triangle, error_m) is asked once for each complete triangle that is reached; broken
  /// ones always split.
  template <class MustSplit>
  void refine(const MustSplit& must_split) {
    for (const BinTriangle& root : root_triangles(errors_.root_side())) pending_.push_back(root);
    while (!pending_.empty()) {
      const BinTriangle triangle = pending_.back();
      pending_.pop_back();
      visit(triangle, must_split);
    }
  }

  /// True if the triangle is bisected. Base vertices beyond the terrain count as enabled while part
  /// of the triangle exists.
  bool is_split(const BinTriangle& triangle) const {
    if (is_finest(triangle)) return false;
    const Corner v = base_vertex(triangle);
    if (enabled_.contains(v.i, v.j)) return enabled_(v.i, v.j) != 0;
    return errors_.error(triangle) != TriangleErrors::kEmpty;
  }
  std::int64_t triangles_visited() const { return visited_; }

 private:
  template <class MustSplit>
  void visit(const BinTriangle& triangle, const MustSplit& must_split) {
    if (is_finest(triangle)) return;
    ++visited_;
    const Corner v = base_vertex(triangle);
    if (enabled_.contains(v.i, v.j) && enabled_(v.i, v.j) != 0)
      return;  // its children were looked at when v was enabled
    const float error = errors_.error(triangle);
    if (error == TriangleErrors::kEmpty) return;
    if (error != TriangleErrors::kBroken && !must_split(triangle, error)) return;
    if (enabled_.contains(v.i, v.j)) {
      enable(v);
    } else {
      for (const BinTriangle& child : children(triangle)) pending_.push_back(child);
    }
  }

  // Enables v and what it depends on; the triangles that come to be are looked at later.
  void enable(Corner first) {
    closing_.push_back(first);
    while (!closing_.empty()) {
      const Corner v = closing_.back();
      closing_.pop_back();
      if (!enabled_.contains(v.i, v.j) || is_root_corner(v) || enabled_(v.i, v.j) != 0) continue;
      enabled_(v.i, v.j) = 1;
      for (int side = 0; side < 2; ++side) {
        const BinTriangle triangle = triangle_of_base(v, side);
        if (outside_root(triangle.c)) continue;
        closing_.push_back(triangle.c);
        for (const BinTriangle& child : children(triangle)) pending_.push_back(child);
      }
    }
  }
  bool outside_root(Corner c) const {
    return std::min(c.i, c.j) < 0 || std::max(c.i, c.j) > errors_.root_side();
  }
  bool is_root_corner(Corner c) const {
    const int side = errors_.root_side();
    return (c.i == 0 || c.i == side) && (c.j == 0 || c.j == side);
  }

  const TriangleErrors& errors_;
  Grid<std::uint8_t> enabled_;
  std::vector<BinTriangle> pending_;
  std::vector<Corner> closing_;
  std::int64_t visited_ = 0;
};

}  // namespace plumb::mesh::restricted_quadtree
