// The point of a heightfield's full-detail surface that is nearest to another point.
#pragma once

#include "reference/height_pyramid.h"
#include "reference/nearest_point.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// Nearest point of the full-detail triangles to `point_m`, found through the pyramid: nodes whose
/// box is farther than the best so far are skipped. Exact to a few roundings of the coordinates; of
/// equal distances the first found, in a fixed order.
///
/// point_m       relative to the terrain's origin, finite
/// max_radius_m  points farther than this are not looked for, >= 0; a good bound makes it fast: the
/// vertical distance
NearestPoint nearest_on_heightfield(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                                    const HeightPyramid& pyramid, const glm::dvec3& point_m,
                                    double max_radius_m);

}  // namespace plumb::reference
