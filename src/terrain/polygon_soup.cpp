#include "terrain/polygon_soup.h"

#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "core/check.h"

namespace plumb::terrain {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

std::uint64_t hash_of(const glm::dvec3& p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

// For each vertex the first one at its place. Zeros must have lost their signs.
std::vector<std::uint32_t> first_at_place(const std::vector<glm::dvec3>& vertices_m) {
  const std::size_t slots = std::bit_ceil(2 * vertices_m.size() + 1);
  std::vector<std::uint32_t> table(slots, kNone);
  std::vector<std::uint32_t> first(vertices_m.size());
  for (std::uint32_t v = 0; v < vertices_m.size(); ++v) {
    std::size_t slot = hash_of(vertices_m[v]) & (slots - 1);
    while (table[slot] != kNone && vertices_m[table[slot]] != vertices_m[v])
      slot = (slot + 1) & (slots - 1);
    if (table[slot] == kNone) table[slot] = v;
    first[v] = table[slot];
  }
  return first;
}

std::vector<Triangle> triangles_of(const PolygonSoup& soup, const std::string& name) {
  std::uint64_t count = 0;
  for (const std::uint32_t size : soup.sizes) count += size < 3 ? 0 : size - 2;
  if (count >= kNone)
    input_error("{}: it has {} triangles, expected at most 2^32 - 2", name, count);
  std::vector<Triangle> triangles;
  triangles.reserve(count);
  std::span<const std::uint32_t> rest(soup.corners);
  for (std::size_t k = 0; k < soup.sizes.size(); ++k) {
    const std::span<const std::uint32_t> corners = rest.first(soup.sizes[k]);
    rest = rest.subspan(soup.sizes[k]);
    if (corners.size() < 3) continue;
    try {
      triangulate(corners, soup.vertices_m, triangles);
    } catch (const std::invalid_argument& error) {
      input_error("{}: face {}, counted from 1: {}", name, k + 1, error.what());
    }
  }
  return triangles;
}

}  // namespace

TriangleMesh joined_mesh(PolygonSoup soup, const std::string& name) {
  for (glm::dvec3& p : soup.vertices_m) p += 0.0;  // -0 becomes 0
  TriangleMesh mesh;
  mesh.triangles = triangles_of(soup, name);
  const std::vector<std::uint32_t> first = first_at_place(soup.vertices_m);
  std::vector<std::uint32_t> number(soup.vertices_m.size(), kNone);
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      corner = first[corner];
      number[corner] = 0;
    }
  }
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.push_back(soup.vertices_m[v]);
  }
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) corner = number[corner];
  }
  return mesh;
}

}  // namespace plumb::terrain
