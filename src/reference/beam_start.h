// How far all rays of a small part of a picture may go before any of them can meet the surface.
#pragma once

#include "core/camera.h"
#include "reference/careful_walk.h"
#include "reference/height_pyramid.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// Rays from one point whose directions lie between `low` and `high`, component by component.
struct Beam {
  glm::dvec3 origin_m;  // in the terrain's coordinates
  glm::dvec3 low, high;
  double t_min, t_max;
};

/// The rays of a camera through the image points of [x0, x1] x [y0, y1].
///
/// origin_m  of the terrain, in the camera's coordinates
Beam camera_beam(const Camera& camera, const glm::dvec3& origin_m, double x0, double y0, double x1,
                 double y1);

struct BeamStart {
  double t;   // no ray of the beam meets the surface before; +inf: none does at all
  int level;  // about the size of the beam there: a good level to begin at, 1 .. top
};

/// Walks the beam through the pyramid as if it were a single thick ray, in intervals.
BeamStart beam_start(const terrain::Heightfield& field, const HeightPyramid& pyramid,
                     const Beam& beam);

}  // namespace plumb::reference
