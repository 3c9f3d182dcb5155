// Stacks of material, drawn by dual contouring over an octree.
#pragma once

#include <memory>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "mesh/dual_contouring/smoothing.h"
#include "mesh/dual_contouring/vertex_place.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/stack_densities.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::mesh::stacks {

struct Parameters {
  Variant variant = Variant::Conservative;
  dual_contouring::Placement placement = dual_contouring::Placement::Mean;
  dual_contouring::Filter filter;
};

/// What does not depend on the view: the levels of the stacks, and the meshes of nodes as they are
/// made.
struct Prepared {
  Parameters parameters;
  std::shared_ptr<const StackDensities> densities;
  std::shared_ptr<NodeCache> cache;
};

/// Throws std::invalid_argument if the field is not valid.
Prepared prepare(terrain::StackField field, const Parameters& parameters = {});

/// The surface that a camera is shown.
///
/// published     nodes are divided while their edge spans more than the tolerance on the screen;
///               one vertex a cell. Nothing is claimed: the tolerance is a size, no error
/// conservative  in metres: the finest level everywhere where the tolerance is 0; see
///               docs/algorithms/material-stacks.md
/// Source: [Löffler, Müller & Schumann 2011].
DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance);

/// The surface of the finest level everywhere: the truth that the others approximate.
DrawnSurface finest(const Prepared& prepared);

/// eq. (1): how many pixels the edge of a node spans where it is nearest to the eye; +inf around
/// the eye. `edge_m` the longest, `box` in the camera's coordinates.
double extent_px(const Camera& camera, const Box& box, double edge_m);

}  // namespace plumb::mesh::stacks
