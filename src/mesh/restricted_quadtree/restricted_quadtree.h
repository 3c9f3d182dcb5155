// Right triangles, bisected where the error asks for it, over a whole terrain.
#pragma once

#include <memory>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "mesh/restricted_quadtree/height_bounds.h"
#include "mesh/restricted_quadtree/triangle_error.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::restricted_quadtree {

struct Parameters {
  int patch_cells =
      128;  // reports name pieces of this many cells along a side; a power of two >= 2
};

/// What does not depend on the view. Keeps a reference to the terrain.
struct Prepared {
  const terrain::Heightfield* field = nullptr;
  Parameters parameters;
  std::shared_ptr<const TriangleErrors> errors;
  std::shared_ptr<const HeightBounds> bounds;
};

/// Throws std::invalid_argument if the terrain is not valid or patch_cells is not as above.
Prepared prepare(const terrain::Heightfield& field, const Parameters& parameters = {});

/// The coarsest conforming triangulation whose every triangle keeps the tolerance; variant
/// `conservative`.
///
///   (1) In metres: every sample lies within the tolerance of the surface drawn above or below it;
///   the camera is not used. (2) In pixels: every sample in view is displaced on screen by at most
///   the tolerance, as is every point between them,
///       since the drawn triangulation is nested in the full-detail one (diagonals `alternating`).
///   (3) Its outline, voids included, is that of the full-detail surface: what exists is drawn,
///   nothing else is. (4) No T-junction: two triangles share a whole edge or none. (5) With
///   tolerance 0 a triangle stays whole only if it passes through all its samples.
/// Source: [Intel sample 2012, algorithms 1 and 2; Lindstrom et al. 1996; Pajarola 1998];
/// departures are named in docs/algorithms/restricted-quadtree.md.
DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance);

}  // namespace plumb::mesh::restricted_quadtree
