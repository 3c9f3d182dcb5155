#include "mesh/stacks/height_cut.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/stacks/height_pieces.h"

namespace plumb::mesh::stacks {
namespace {

using Polygon = std::vector<std::uint32_t>;

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
// Of the largest ear's area: roundings of points on one line make far less.
constexpr double kFlatEar = 1e-9;
// Of the spacing: a vertex as near to a line of samples is moved onto it. Edges often pass through
// samples, and rounding is not to decide on which side.
constexpr double kOnLine = 1e-9;

void snap(const HeightSurface& heights, glm::dvec3& place) {
  const auto snapped = [](double at_m, double step_m) {
    const double line = std::round(at_m / step_m);
    return std::abs(at_m / step_m - line) < kOnLine ? line * step_m : at_m;
  };
  place.x = snapped(place.x, heights.dx_m());
  place.y = snapped(place.y, heights.dy_m());
}

// The new vertices, each on an edge between two that were there before it.
class CutEdges {
 public:
  CutEdges(const HeightSurface& heights, TriangleMesh& mesh, std::vector<glm::vec3>& colours)
      : heights_(heights), mesh_(mesh), colours_(colours), is_end_(mesh.vertices_m.size(), 0) {}

  PieceCorner corner(std::uint32_t name) const { return {mesh_.vertices_m[name], name}; }

  PieceCorner cut(PieceCorner a, double at_a, PieceCorner b, double at_b, const CutLine& line) {
    if (a.name > b.name) {
      std::swap(a, b);
      std::swap(at_a, at_b);
    }
    const auto next = static_cast<std::uint32_t>(mesh_.vertices_m.size());
    const auto [found, is_new] = middle_.try_emplace(key(a.name, b.name), next);
    if (!is_new) return corner(found->second);
    mesh_.vertices_m.push_back(crossing_m(a, at_a, b, at_b, line));
    snap(heights_, mesh_.vertices_m.back());
    if (!colours_.empty())
      colours_.push_back(
          glm::mix(colours_[a.name], colours_[b.name], static_cast<float>(at_a / (at_a - at_b))));
    is_end_.push_back(0);
    is_end_[a.name] = is_end_[b.name] = 1;
    return corner(next);
  }

  /// Whether an edge of it may have been cut.
  bool may_be_cut(const Triangle& triangle) const {
    return is_end_[triangle[0]] + is_end_[triangle[1]] + is_end_[triangle[2]] > 1;
  }
  /// A polygon with all vertices that its edges were cut at.
  Polygon whole(const Polygon& polygon) const {
    Polygon whole;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      whole.push_back(polygon[k]);
      add_between(polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0], whole);
    }
    return whole;
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
  }
  void add_between(std::uint32_t a, std::uint32_t b, Polygon& polygon) const {
    const auto found = middle_.find(key(a, b));
    if (found == middle_.end()) return;
    add_between(a, found->second, polygon);
    polygon.push_back(found->second);
    add_between(found->second, b, polygon);
  }

  const HeightSurface& heights_;
  TriangleMesh& mesh_;
  std::vector<glm::vec3>& colours_;
  std::vector<std::uint8_t> is_end_;  // of a cut edge
  std::unordered_map<std::uint64_t, std::uint32_t> middle_;
};

// Cuts the smallest ear off that has an area, so that what is left has one too.
void add_triangles(const TriangleMesh& mesh, Polygon polygon, std::vector<Triangle>& triangles) {
  const auto around = [&](std::size_t k) {
    const std::size_t count = polygon.size();
    return Triangle{polygon[(k + count - 1) % count], polygon[k], polygon[(k + 1) % count]};
  };
  const auto area = [&](const Triangle& t) {
    const glm::dvec3& at = mesh.vertices_m[t[1]];
    return glm::length(glm::cross(mesh.vertices_m[t[0]] - at, mesh.vertices_m[t[2]] - at));
  };
  while (polygon.size() > 3) {
    double largest = 0.0, least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < polygon.size(); ++k) largest = std::max(largest, area(around(k)));
    std::size_t ear = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const double of_ear = area(around(k));
      if (of_ear > kFlatEar * largest && of_ear < least) {
        least = of_ear;
        ear = k;
      }
    }
    triangles.push_back(around(ear));
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back(around(1));
}

// Pieces that are kept, of triangle after triangle.
struct Pieces {
  std::vector<Polygon> polygons;
  std::vector<std::size_t> first;  // of each triangle, and their number at the end
  std::vector<std::uint8_t> is_cut;
};

// Snaps the corners of those that are to be cut.
std::vector<std::uint8_t> cut_triangles(const HeightSurface& heights, TriangleMesh& mesh) {
  std::vector<std::uint8_t> is_cut;
  for (const Triangle& triangle : mesh.triangles) {
    Box box;
    for (const std::uint32_t corner : triangle) box.add(mesh.vertices_m[corner]);
    is_cut.push_back(heights.is_whole(box.low, box.high) ? 0 : 1);
  }
  for (std::size_t t = 0; t < is_cut.size(); ++t) {
    if (is_cut[t] == 0) continue;
    for (const std::uint32_t corner : mesh.triangles[t]) snap(heights, mesh.vertices_m[corner]);
  }
  return is_cut;
}

Pieces pieces_of(const HeightSurface& heights, TriangleMesh& mesh, CutEdges& edges) {
  Pieces pieces;
  pieces.is_cut = cut_triangles(heights, mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    pieces.first.push_back(pieces.polygons.size());
    if (pieces.is_cut[t] == 0) continue;
    Piece whole;
    for (const std::uint32_t corner : mesh.triangles[t]) whole.add(edges.corner(corner));
    for_each_height_piece(
        heights, whole,
        [&](const PieceCorner& a, double at_a, const PieceCorner& b, double at_b,
            const CutLine& line) { return edges.cut(a, at_a, b, at_b, line); },
        [&](const CellHalf& half, const Piece& piece) {
          if (!heights.exists(half)) return;
          Polygon polygon;
          for (const PieceCorner& corner : piece) polygon.push_back(corner.name);
          pieces.polygons.push_back(std::move(polygon));
        });
  }
  pieces.first.push_back(pieces.polygons.size());
  return pieces;
}

// Leaves out the vertices that no triangle has.
void drop_unused(TriangleMesh& mesh, std::vector<glm::vec3>& colours) {
  std::vector<std::uint32_t> index(mesh.vertices_m.size(), kUnused);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) index[corner] = 0;
  }
  std::uint32_t count = 0;
  for (std::size_t k = 0; k < index.size(); ++k) {
    if (index[k] == kUnused) continue;
    index[k] = count;
    mesh.vertices_m[count] = mesh.vertices_m[k];
    if (!colours.empty()) colours[count] = colours[k];
    ++count;
  }
  mesh.vertices_m.resize(count);
  if (!colours.empty()) colours.resize(count);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = index[corner];
  }
}

bool is_whole(const HeightSurface& heights) {
  return heights.is_whole(glm::dvec3(0.0), {heights.cell_columns() * heights.dx_m(),
                                            heights.cell_rows() * heights.dy_m(), 0.0});
}

}  // namespace

void cut_to_heights(const HeightSurface& heights, DrawnSurface& surface) {
  if (is_whole(heights)) return;
  const TriangleMesh& before = *surface.mesh;
  auto mesh = std::make_shared<TriangleMesh>(before);
  CutEdges edges(heights, *mesh, surface.vertex_colours);
  const Pieces pieces = pieces_of(heights, *mesh, edges);
  std::vector<Triangle> triangles;
  std::vector<Patch> patches;
  std::vector<std::uint8_t> lod;
  for (Patch patch : surface.patches) {
    const std::size_t first = patch.first_triangle, last = first + patch.triangle_count;
    patch.first_triangle = static_cast<std::uint32_t>(triangles.size());
    for (std::size_t t = first; t < last; ++t) {
      const Triangle triangle = before.triangles[t];
      if (pieces.is_cut[t] == 0) {
        if (edges.may_be_cut(triangle)) {
          add_triangles(*mesh, edges.whole({triangle.begin(), triangle.end()}), triangles);
        } else {
          triangles.push_back(triangle);
        }
      }
      for (std::size_t k = pieces.first[t]; k < pieces.first[t + 1]; ++k)
        add_triangles(*mesh, edges.whole(pieces.polygons[k]), triangles);
    }
    patch.triangle_count = static_cast<std::uint32_t>(triangles.size()) - patch.first_triangle;
    if (patch.triangle_count == 0) continue;
    lod.insert(lod.end(), patch.triangle_count, static_cast<std::uint8_t>(patch.lod));
    patches.push_back(std::move(patch));
  }
  mesh->triangles = std::move(triangles);
  drop_unused(*mesh, surface.vertex_colours);
  surface.patches = std::move(patches);
  surface.triangle_lod = std::move(lod);
  surface.cost.vertices = static_cast<std::int64_t>(mesh->vertices_m.size());
  surface.cost.triangles = static_cast<std::int64_t>(mesh->triangles.size());
  surface.mesh = std::move(mesh);
}

}  // namespace plumb::mesh::stacks
