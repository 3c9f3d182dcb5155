// Meshes with a known shape.
#pragma once

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "core/triangle_mesh.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

/// A sphere about zero: an octahedron whose triangles are cut into four `cuts` times, every vertex
/// at `radius_m`. 8 * 4^cuts triangles that share their vertices.
inline TriangleMesh sphere_mesh(double radius_m, int cuts) {
  TriangleMesh mesh;
  mesh.vertices_m = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, added] = middles.try_emplace(
          std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices_m.size()));
      if (added) mesh.vertices_m.push_back(glm::normalize(mesh.vertices_m[a] + mesh.vertices_m[b]));
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (glm::dvec3& v : mesh.vertices_m) v *= radius_m;
  return mesh;
}

/// Greatest depth of the mesh of a sphere below it: a plane through three points of the sphere that
/// lie on a circle of radius c passes the middle at sqrt(r^2 - c^2), and the triangle no nearer.
inline double sagitta_m(const TriangleMesh& sphere, double radius_m) {
  double largest_squared = 0.0;  // c^2 of a triangle: (product of its edges / (4 area))^2
  for (const Triangle& t : sphere.triangles) {
    const glm::dvec3 &a = sphere.vertices_m[t[0]], &b = sphere.vertices_m[t[1]],
                     &c = sphere.vertices_m[t[2]];
    const glm::dvec3 normal = area_normal(a, b, c);
    const double edges = glm::distance(a, b) * glm::distance(b, c) * glm::distance(c, a);
    largest_squared = std::max(largest_squared, edges * edges / (4.0 * glm::dot(normal, normal)));
  }
  return radius_m - std::sqrt(radius_m * radius_m - largest_squared);
}

/// The full-detail triangles of a heightfield that exist, in the order of their indices.
inline TriangleMesh mesh_of(const terrain::Heightfield& field, terrain::Diagonal diagonal) {
  TriangleMesh mesh;
  mesh.origin_m = field.world_origin_m();
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      const double z = field.is_void(i, j) ? 0.0 : field.heights_m(i, j);
      mesh.vertices_m.push_back({i * field.dx_m, j * field.dy_m, z});
    }
  }
  const auto add = [&](std::array<std::array<int, 2>, 3> samples) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (field.is_void(samples[k][0], samples[k][1])) return;
      triangle[k] = static_cast<std::uint32_t>(field.heights_m.index(samples[k][0], samples[k][1]));
    }
    mesh.triangles.push_back(triangle);
  };
  for (int j = 0; j < field.cell_rows(); ++j) {
    for (int i = 0; i < field.cell_columns(); ++i) {
      if (rises_north_east(diagonal, i, j)) {
        add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
        add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
      } else {
        add({{{i, j}, {i + 1, j}, {i, j + 1}}});
        add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
    }
  }
  return mesh;
}

}  // namespace plumb::test_support
