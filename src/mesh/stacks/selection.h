// Which nodes a camera asks for.
#pragma once

#include "core/box.h"
#include "core/camera.h"
#include "core/claim.h"
#include "mesh/stacks/errors.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/stack_densities.h"

namespace plumb::mesh::stacks {

/// eq. (1): how many pixels the edge of a node spans where it is nearest to the eye; +inf around
/// the eye. `box` is in the camera's coordinates.
double extent_px(const Camera& camera, const Box& box, double edge_m);

/// A bound of how far apart a point of a box that is in view and one at most `distance_m` from it
/// are seen, pixels; +inf where the eye is as near as that.
///
/// From the eye they are at most the angle asin(distance / D) apart, D the least distance of the
/// box; the picture stretches an angle most where it is farthest from its centre, in the box and in
/// the picture: tan(a + b) - tan(a) = t (1 + s^2) / (1 - s t), s = tan a there, t = tan b.
double apart_px(const Camera& camera, const Box& box, double distance_m);

/// As printed: nodes are divided while their edge spans more pixels than the tolerance.
Octree published_selection(const StackDensities& densities, const Camera& camera,
                           const Tolerance& tolerance);

/// Nodes in view are divided until every bound of what is drawn there, and of what it stands for
/// there, is within the tolerance, or the finest level is drawn. Nodes out of view are as coarse as
/// those in view let them be.
///
///   (1) The same whatever was selected and measured before.
Octree conservative_selection(const StackDensities& densities, Errors& errors, NodeCache& cache,
                              const Camera& camera, const Tolerance& tolerance);

}  // namespace plumb::mesh::stacks
