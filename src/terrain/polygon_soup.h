// Polygons as files have them, and the triangle mesh that they are. Not for users of the library.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace plumb::terrain {

struct PolygonSoup {
  std::vector<glm::dvec3> vertices_m;  // finite, at most 2^32 - 2
  std::vector<std::uint32_t> corners;  // indices of vertices, of all polygons one behind another
  std::vector<std::uint32_t> sizes;    // corners of each polygon
};

/// Vertices that a file may have: indices are 32 bits, and the last one means none.
inline constexpr std::uint64_t kMostVertices = 0xfffffffeu;

/// Cuts a polygon of n >= 3 corners into n - 2 triangles, which turn as it does.
///
///   (1) One that turns the same way at each corner becomes a fan around its first corner.
///   (2) Any other loses ear after ear, seen along its vector of area; what has no ear left (it
///   cuts
///       itself, or has no area) becomes a fan.
/// Throws std::invalid_argument for an uneven one of more than kMostUnevenCorners.
/// Source: the theorem of two ears, [Meisters 1975].
void triangulate(std::span<const std::uint32_t> corners, std::span<const glm::dvec3> vertices_m,
                 std::vector<Triangle>& triangles);

inline constexpr std::size_t kMostUnevenCorners = 1000;

/// The triangles of all polygons in their order; a polygon of fewer than three corners draws
/// nothing.
///
///   (1) Vertices at one place (equal coordinates; the two zeros are equal) become one.
///   (2) Vertices of no triangle are left out; the others keep their order.
/// `name` begins the messages of its InputErrors: more triangles than 32 bits count, an uneven
/// polygon of too many corners.
TriangleMesh joined_mesh(PolygonSoup soup, const std::string& name);

}  // namespace plumb::terrain
