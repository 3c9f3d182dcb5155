// A heightfield and its pyramid made ready for lane_walk.h.
#pragma once

#include "reference/height_pyramid.h"
#include "reference/lane_walk.h"
#include "reference/ray.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// ray  any of those that are to be walked: its origin and its ends are everyone's. The scene keeps
///      pointers to the heights and the pyramid.
LaneScene lane_scene(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                     const HeightPyramid& pyramid, const Ray& ray);

/// Walks the rays with this processor's instructions. All are undecided, to be walked from their
/// beginning, where the terrain has more samples than lanes can count.
void walk_lanes(const terrain::Heightfield& field, const LaneScene& scene, LaneRays& rays);

}  // namespace plumb::reference
