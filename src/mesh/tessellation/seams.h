// Walls that close what is open between patches of two levels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "mesh/tessellation/block_levels.h"
#include "mesh/tessellation/patch_mesh.h"

namespace plumb::mesh::tessellation {

/// A corner of a wall: a vertex of a drawn patch's rim, or a place of its own (relative to the
/// terrain's origin).
struct SeamCorner {
  std::int32_t drawn = -1;  // the patch, by its place in PatchSelection::drawn; -1: `place_m`
  PatchPoint point;
  glm::dvec3 place_m{0.0};
};
using SeamTriangle = std::array<SeamCorner, 3>;

/// Vertical triangles between a drawn patch's rim and those of coarser patches beside it.
///
///   (1) Where both rims are drawn, no gap between the two is left open. (2) What is between them
///   is filled and little else: a wall hangs below the lower rim by at most an eighth of the
///   tolerance, so that rounded vertices leave no pixel open, and not at all where the two meet in
///   a vertex: at the terrain's rim and beside voids nothing shows that is farther from the truth
///   than the surfaces are.
/// Departure from [Yusov & Shevtsov 2011, section 5], whose skirts are as deep as any crack can be:
/// they would show through voids and beyond the terrain's rim.
std::vector<SeamTriangle> seams_of(const Prepared& prepared, const ViewTest& view,
                                   const PatchSelection& selection,
                                   const std::vector<Grid<float>>& heights_m,
                                   const ChosenLevels& levels, const std::vector<PatchMesh>& meshes,
                                   std::size_t drawn);

}  // namespace plumb::mesh::tessellation
