// How the triangles of a solid's drawn surface hang together: reported, never assumed.
#pragma once

#include "audit/mesh_edges.h"
#include "audit/mesh_truth.h"
#include "audit/topology.h"

namespace plumb::audit {

/// Of a surface that should be closed but for the terrain's outline: the rectangle of its outermost
/// samples, origin to ((columns - 1) dx, (rows - 1) dy), whose sides it reaches and ends at.
///
/// open         an edge of one triangle whose ends do not both lie on one side of the outline, to
///              10^-6 of a spacing
/// T-junction   as topology.h has it, in space
/// folded       an edge whose two triangles' normals are more than 150 degrees apart: ground less
///              than a wedge of 30 degrees, which no density that is smooth over a voxel has
/// overlapped   is not told: sheets lie over each other by right
Topology solid_topology_of(const MeshTruth& truth, const DrawnSurface& surface,
                           const MeshEdges& edges, int most_listed);

}  // namespace plumb::audit
