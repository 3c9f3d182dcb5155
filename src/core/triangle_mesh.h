// Indexed triangles.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "core/box.h"

namespace plumb {

/// Corners of a triangle as indices of vertices, counter-clockwise seen from above (or from
/// outside).
using Triangle = std::array<std::uint32_t, 3>;

/// Vertices are doubles relative to `origin_m`, so that a mesh of 160 km in UTM coordinates keeps
/// its digits.
struct TriangleMesh {
  glm::dvec3 origin_m{0.0};
  std::vector<glm::dvec3> vertices_m;  // relative to origin_m
  std::vector<Triangle> triangles;     // at most 2^32 - 2
};

inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

/// Twice the corners' area as a vector; points upwards for a counter-clockwise triangle.
inline glm::dvec3 area_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 u = b - a, v = c - a;
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Box of all vertices, relative to the mesh's origin.
inline Box bounds(const TriangleMesh& mesh) {
  Box box;
  for (const glm::dvec3& v : mesh.vertices_m) box.add(v);
  return box;
}

}  // namespace plumb
