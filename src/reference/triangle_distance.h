// The point of a triangle that is nearest to another point, in double.
#pragma once

#include <glm/vec3.hpp>

namespace plumb::reference {

/// Nearest point to `point` of the closed triangle (a, b, c).
///
///   (1) The result is a convex combination of the corners: it never claims a distance that no
///       point of the triangle has, whatever the triangle's shape.
///   (2) Triangles without area, down to a point, are their edges.
///   (3) Where the nearest point lies on an edge, both triangles of that edge give the same bits.
/// For coordinates far from zero subtract a common origin first.
glm::dvec3 nearest_on_triangle(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b,
                               const glm::dvec3& c);

/// Nearest point to `point` of the closed segment from a to b; the same bits for (b, a).
glm::dvec3 nearest_on_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b);

}  // namespace plumb::reference
