// Which nodes a camera asks for.
#pragma once

#include "core/box.h"
#include "core/camera.h"
#include "core/claim.h"
#include "mesh/stacks/level_errors.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/stack_densities.h"

namespace plumb::mesh::stacks {

/// eq. (1): how many pixels the edge of a node spans where it is nearest to the eye; +inf around
/// the eye. `box` is in the camera's coordinates.
double extent_px(const Camera& camera, const Box& box, double edge_m);

/// A bound of how far apart a point of a box and one at most `distance_m` from it are seen, pixels,
/// where one of them is in view; +inf where the eye is as near as that.
///
/// From the eye they are at most the angle asin(distance / D) apart, D the least distance of the
/// box; the picture stretches an angle most at the corner that is farthest from its centre:
/// tan(a + b) - tan(a) = t (1 + s^2) / (1 - s t), s = tan a there, t = tan b.
double apart_px(const Camera& camera, const Box& box, double distance_m);

/// As printed: nodes are divided while their edge spans more pixels than the tolerance.
Octree published_selection(const StackDensities& densities, const Camera& camera,
                           const Tolerance& tolerance);

/// Nodes in view are divided until every bound of what is drawn is within the tolerance; where the
/// finest level is drawn it is zero.
Octree conservative_selection(const StackDensities& densities, const LevelErrors& levels,
                              NodeCache& cache, const Camera& camera, const Tolerance& tolerance);

}  // namespace plumb::mesh::stacks
