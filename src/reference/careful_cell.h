// A ray within one cell of a heightfield: two triangles, and no doubt left.
#pragma once

#include "reference/careful_ray.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// What the ray meets in cell (i, j) is added to what it has found. Where rounding could decide,
/// the triangles as closed sets do (closed_triangle.h).
void meet_cell(CarefulRay& ray, const terrain::Heightfield& field, terrain::Diagonal diagonal,
               int i, int j);

}  // namespace plumb::reference
