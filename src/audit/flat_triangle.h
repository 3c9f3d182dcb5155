// A drawn triangle seen from straight above: which places it covers, and at what height.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/triangle_mesh.h"

namespace plumb::audit {

enum class Cover { Outside, Edge, Inside };

/// Corners in the terrain's coordinates, turned counter-clockwise as seen from above.
///
/// A place counts as on an edge if it lies nearer to it than rounding can tell, so that no place
/// falls between two triangles that share an edge; it is then evaluated on the edge, never beyond.
struct FlatTriangle {
  glm::dvec3 a, b, c;
  double area;   // twice the area in the plane, square metres, >= 0
  double slack;  // more than the rounding of an edge function, square metres

  FlatTriangle(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) : a(p), b(q), c(r) {
    area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area < 0.0) {
      std::swap(b, c);
      area = -area;
    }
    const double reach = std::max(
        {std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y), std::abs(c.x), std::abs(c.y)});
    const double length = std::max({a.x, b.x, c.x}) - std::min({a.x, b.x, c.x}) +
                          std::max({a.y, b.y, c.y}) - std::min({a.y, b.y, c.y});
    // Differences round by half an ulp of the coordinates, products by as much again; eight terms
    // at most.
    slack = 8.0 * std::numeric_limits<double>::epsilon() * reach * length;
  }

  /// False for triangles that are vertical or have no area: they stand over no place.
  bool is_flat() const { return area > slack; }

  /// Height over (x, y) in `z` unless the place is outside.
  Cover cover(double x, double y, double& z) const {
    const double at_a = edge(b, c, x, y), at_b = edge(c, a, x, y), at_c = edge(a, b, x, y);
    const double least = std::min({at_a, at_b, at_c});
    if (least < -slack) return Cover::Outside;
    const double wa = std::max(at_a, 0.0), wb = std::max(at_b, 0.0), wc = std::max(at_c, 0.0);
    z = a.z + (wb * (b.z - a.z) + wc * (c.z - a.z)) / (wa + wb + wc);
    return least > slack ? Cover::Inside : Cover::Edge;
  }

 private:
  static double edge(const glm::dvec3& p, const glm::dvec3& q, double x, double y) {
    return (p.x - x) * (q.y - y) - (p.y - y) * (q.x - x);
  }
};

/// A triangle of a mesh, moved by `shift`.
inline FlatTriangle flat_triangle(const TriangleMesh& mesh, std::uint32_t index,
                                  const glm::dvec3& shift) {
  const Triangle& t = mesh.triangles[index];
  return {mesh.vertices_m[t[0]] + shift, mesh.vertices_m[t[1]] + shift,
          mesh.vertices_m[t[2]] + shift};
}

}  // namespace plumb::audit
