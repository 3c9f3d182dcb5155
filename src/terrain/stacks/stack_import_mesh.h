// Stacks from a closed triangle mesh: a solid, or the void that it leaves in rock.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

struct MeshStackOptions {
  double spacing_m = 1.0;  // of stacks, > 0; they stand on multiples of it from the mesh's origin
  double voxel_m = 0.0;    // height of a voxel; 0: as the spacing
  bool subtract = false;   // the mesh bounds a void in rock
  double below_m = 0.0, above_m = 0.0;  // >= 0; of rock, below the lowest vertex, above the highest
  double beside_m = 0.0;                // >= 0; the field's margin beyond the mesh
  std::string material = "rock";
};

struct MeshStacks {
  StackField field;
  std::int64_t triangles = 0;
  std::int64_t non_manifold_edges = 0;  // of more than two triangles
  std::int64_t unbalanced_edges = 0;    // whose triangles do not agree which side is out
  std::int64_t repaired = 0;            // stacks, from a neighbour, since the mesh is open there
  int first_repaired_column = -1, first_repaired_row = -1;
};

/// A height is inside the mesh where its winding number, the sum of signed crossings of the stack's
/// vertical line below, is not zero: however the mesh is wound, and where parts overlap.
///
///   (1) Edges and vertices on a stack's line change nothing: see column_crossings.h.
///   (2) A stack on whose line the winding does not come back to zero (a mesh with edges that are
///       not balanced) gets the layers of the nearest neighbour in its row or column that is sound,
///       and is counted; provenance says so.
/// `source` names the mesh in errors and provenance. The field has its origin's x and y; heights
/// are world heights.
/// Throws InputError for a mesh that is not closed (how many edges have one triangle, and where the
/// first lies), more than a hundredth of its stacks to be repaired, or more than fit into memory;
/// std::invalid_argument for options that are not as above.
MeshStacks stacks_of_mesh(const TriangleMesh& mesh, const std::string& source,
                          const MeshStackOptions& options = {});

/// The volume that a closed mesh bounds, by the divergence theorem: above zero if it is wound
/// outwards, cubic metres.
double signed_volume_m3(const TriangleMesh& mesh);

/// Cubic metres of each material, by its index, each stack counted for a cell of dx x dy: air as
/// far as the end of the stack's last layer.
std::vector<double> volumes_m3(const StackField& field);

}  // namespace plumb::terrain
