// Makes what a picture sees readable: light, height colours, sky.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>
#include <span>
#include <vector>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"
#include "image/colour_image.h"

namespace plumb::raster {

/// One light from far away, and a sky that lights what faces up.
struct Light {
  // From north-west, 45 degrees above the horizon: as maps are shaded. Need not be of unit length.
  glm::dvec3 towards{-0.5, 0.5, 0.70710678118654752440};
  double ambient = 0.35;  // the sky's share of the light on level ground, in [0, 1]
};

/// Linear colours by the view's elevation.
struct Sky {
  glm::dvec3 zenith{0.13, 0.27, 0.56};
  glm::dvec3 horizon{0.66, 0.76, 0.86};
  glm::dvec3 below{0.17, 0.19, 0.22};  // where a view goes below the horizon and meets nothing
};

/// A picture laid over the ground from above: its top side lies in the north.
struct Drape {
  const image::ColourImage* picture = nullptr;  // at least 1 x 1
  glm::dvec2 low_m{0.0};                        // world coordinates of its south-west corner
  glm::dvec2 high_m{1.0};                       // and of its north-east corner, above low_m
};

struct ShadeOptions {
  Light light;
  Sky sky;
  double low_m = 0.0;   // world height of the lowest tint
  double high_m = 1.0;  // and of the highest; where not above low_m, everything has the lowest
  Drape drape;          // in place of the tint where it has a picture
  std::span<const glm::vec3> albedo;  // linear, a pixel each, in place of both; empty: none
  double haze_m = std::numeric_limits<double>::infinity();  // depth at which half is horizon, > 0
  /// Turns normals to the side that is seen, as a sheet of triangles wants it; false for a solid,
  /// whose every point is lit as the ground there.
  bool two_sided = true;
};

/// Linear colour of a height: green at 0, through yellow and brown to white at 1; clamped.
glm::dvec3 hypsometric_tint(double share);

/// Linear colour of the sky in a direction of any length but zero.
glm::dvec3 sky_colour(const Sky& sky, const glm::dvec3& direction);

/// Unit normal of the triangle that each pixel sees, by the way that its corners run (upwards for a
/// terrain); zero where nothing is seen or the triangle has no area. Throws std::invalid_argument
/// if a hit names a triangle that the mesh does not have.
std::vector<glm::dvec3> flat_normals(const TriangleMesh& mesh, const HitImage& hits);

/// Linear colour of one point of the surface, haze included.
///
/// normal  unit; the same for both sides where options.two_sided
glm::dvec3 surface_colour(const Camera& camera, const glm::dvec3& from_eye_m,
                          const glm::dvec3& normal, double depth_m, const ShadeOptions& options);

/// The picture in linear light.
///
/// normals  one a pixel, unit; either side of the surface is lit alike where it has two
///
///   (1) Same bits on any number of threads.
///   (2) Pixels without a hit show the sky of their own direction.
/// Throws std::invalid_argument if shapes differ or an option is out of range.
image::ColourImage shade(const HitImage& hits, const Camera& camera,
                         std::span<const glm::dvec3> normals, const ShadeOptions& options = {});

}  // namespace plumb::raster
