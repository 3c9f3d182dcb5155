// What is drawn for heights ends where they do.
#pragma once

#include "core/drawn_surface.h"
#include "mesh/stacks/height_surface.h"

namespace plumb::mesh::stacks {

/// Cuts off what lies above or below no full-detail triangle: beside voids and within them.
///
/// Triangles that no void comes near stay as they are, but where a neighbour's cut has put vertices
/// on an edge of theirs; so it has the two triangles at every edge that it had, and open ones along
/// the voids alone. Vertices keep their order, new ones follow.
void cut_to_heights(const HeightSurface& heights, DrawnSurface& surface);

}  // namespace plumb::mesh::stacks
