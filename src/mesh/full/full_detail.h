// The baseline: every sample a vertex, every cell two triangles.
#pragma once

#include <memory>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "terrain/heightfield.h"

namespace plumb::mesh::full {

struct Parameters {
  terrain::Diagonal diagonal = terrain::Diagonal::Alternating;
};

struct Prepared {
  DrawnSurface surface;
};

/// The full-detail mesh: the triangles of `diagonal` whose three samples exist, in patches of 64 x
/// 64 cells.
///
///   (1) Claims error zero, in metres and in pixels, whatever the tolerance.
///   (2) Vertices are the samples that a triangle uses, row by row from the south.
Prepared prepare(const terrain::Heightfield& field, const Parameters& parameters = {});

/// The same surface for every camera and tolerance.
DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance);

}  // namespace plumb::mesh::full
