// One ray through the pyramid, with every doubt settled: what the kernels of lane_walk.h must
// equal.
#pragma once

#include <glm/vec3.hpp>

#include <limits>

#include "reference/height_pyramid.h"
#include "reference/ray.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// How much rounding may hide on rays from one origin, and between which heights they are followed.
struct WalkLimits {
  double height_slack;  // more than the roundings of z + t * dz and of a height between samples, m
  double place_slack;   // more than the roundings of u + t * du, cells
  double lowest, highest;  // nothing is met outside; well clear of all heights, so that a hit on
                           // the lowest plain is not the end of its ray
};

WalkLimits walk_limits(const terrain::Heightfield& field, const HeightPyramid& pyramid,
                       const glm::dvec3& origin_m);

/// A direction component so small beside the others that a ray of it crosses no cell within any
/// terrain counts as zero: 1e-30 cells (or metres) a unit of the largest.
inline constexpr double kStillDirection = 1e-30;

/// The first hit of a ray, finite and with a direction, in the terrain's coordinates. Depth first,
/// the children that the ray meets first before the others.
///
/// t_from  what the ray has left before is known to be no hit, and by more than a slack, so that
///         starting there changes no bit; the cell before must be known as well, whose side of the
///         surface the walk remembers
RayHit walk_carefully(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                      const HeightPyramid& pyramid, const Ray& ray,
                      double t_from = -std::numeric_limits<double>::infinity());

}  // namespace plumb::reference
