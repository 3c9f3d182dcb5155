// The points that pixels show, once it is known which triangle each of them shows.
#pragma once

#include <glm/vec3.hpp>

#include "core/hit_image.h"
#include "raster/binning.h"

namespace plumb::raster {

/// The point of a triangle of the mesh with these barycentric coordinates, relative to the eye.
inline glm::dvec3 triangle_point(const Geometry& geometry, std::uint32_t triangle,
                                 const glm::dvec3& weights) {
  const Triangle& corners = geometry.mesh->triangles[triangle];
  const auto corner = [&](std::size_t i) {
    return geometry.projection.from_eye(geometry.mesh->vertices_m[corners[i]]);
  };
  return weights.x * corner(0) + weights.y * corner(1) + weights.z * corner(2);
}

/// Fills in `from_eye_m` of every pixel that shows a whole triangle, from its depth and primitive;
/// those that show a triangle with a corner cut off are left as they are. In parallel by rows.
void fill_points(const Geometry& geometry, HitImage& image);

}  // namespace plumb::raster
