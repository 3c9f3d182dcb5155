// Stacks of material, drawn by dual contouring over an octree.
#pragma once

#include <memory>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "mesh/dual_contouring/smoothing.h"
#include "mesh/dual_contouring/vertex_place.h"
#include "mesh/stacks/amortised_tree.h"
#include "mesh/stacks/errors.h"
#include "mesh/stacks/height_errors.h"
#include "mesh/stacks/height_surface.h"
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
/// made and measured. Frames may share it, from several threads too: what is drawn depends on
/// nothing but the camera.
struct Prepared {
  Parameters parameters;
  std::shared_ptr<const StackDensities> densities;
  std::shared_ptr<NodeCache> cache;
  std::shared_ptr<Errors> errors;                   // null: published
  std::shared_ptr<HeightErrors> errors_of_heights;  // the same; null: of stacks
};

/// heights  what the stacks stand for, if they are a heightfield's and of one layer; null: the
///          finest level's surface is what is drawn. The published variant does not look at it
/// Throws std::invalid_argument if the field is not valid.
Prepared prepare(terrain::StackField field, const Parameters& parameters = {},
                 const std::shared_ptr<const HeightSurface>& heights = nullptr);

/// The surface that a camera is shown.
///
/// published     nodes are divided while their edge spans more pixels than the tolerance; one
/// vertex
///               a cell. Nothing is claimed: that tolerance is a size, no error
/// conservative  nodes in view are divided until what is drawn lies within the tolerance of the
///               finest level's surface, both ways; a vertex for each sheet. Claims so of a field
///               of stacks. Of heights it is their own triangles that it is measured against, up
///               and down: it ends where they do, and claims the tolerance, or what the finest
///               level reaches where that misses it
/// Source: [Löffler, Müller & Schumann 2011].
DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance);

/// A flight: after its first frame, what is drawn follows what the camera asks for by `budget` node
/// meshes a frame.
class Run {
 public:
  /// budget  0: none, each frame is draw()'s
  Run(Prepared prepared, int budget);
  /// With a budget nothing is claimed, as what is drawn may lag behind. A note says what was
  /// changed and what waits.
  DrawnSurface step(const Camera& camera, const Tolerance& tolerance);

 private:
  Prepared prepared_;
  AmortisedTree tree_;
  int budget_;
  bool is_started_ = false;
};

/// The surface of the finest level everywhere: the truth that the others approximate.
DrawnSurface finest(const Prepared& prepared);

}  // namespace plumb::mesh::stacks
