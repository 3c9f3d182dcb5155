// How the triangles of a drawn mesh hang together: reported, never assumed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "audit/mesh_edges.h"
#include "audit/truth.h"
#include "core/drawn_surface.h"

namespace plumb::audit {

/// A place where the mesh is not what a sheet over the terrain should be.
struct TopologyFlaw {
  std::string kind;      // "open edge", "T-junction", "non-manifold edge", "non-manifold vertex",
                         // "degenerate", "folded"
  glm::dvec3 at_m{0.0};  // relative to the terrain's origin
  std::uint32_t triangle = kNoPrimitive;
  int patch = -1;
};

struct Topology {
  std::int64_t triangles = 0, vertices = 0;
  std::int64_t boundary_edges = 0;  // of one triangle only
  std::int64_t open_edges = 0;      // of those, inside the terrain's surface: where none should be
  std::int64_t t_junctions = 0;     // vertices in the inside of an open edge
  std::int64_t non_manifold_edges =
      0;  // of three triangles or more, or of two that run the same way round
  std::int64_t non_manifold_vertices = 0;  // whose triangles do not form a single fan
  std::int64_t degenerate_triangles = 0;   // no area, or a corner named twice
  /// Facing down; of a solid's surface, edges whose two triangles are folded together.
  std::int64_t folded_triangles = 0;
  std::int64_t overlapped_samples =
      0;  // samples inside more than one triangle: sheets over each other (from the samples)
  /// Pairs of triangles without a common vertex that pass through each other; -1 where nobody
  /// looked (self_intersections.h).
  std::int64_t self_intersections = -1;
  int largest_lod_jump = 0;          // between triangles that share an edge
  std::vector<TopologyFlaw> listed;  // the first of each kind, at most `most_listed` of a kind

  bool is_sound() const {
    return open_edges + non_manifold_edges + non_manifold_vertices + degenerate_triangles +
               folded_triangles ==
           0;
  }
};

/// Everything but `overlapped_samples`. An edge of one triangle is open if the full-detail surface
/// exists on both of its sides; vertical triangles (skirts) are neither folded nor open. Two
/// vertices at one place are two vertices: a mesh that does not share them is open along its seams,
/// which is what a crack needs.
Topology topology_of(const HeightfieldTruth& truth, const DrawnSurface& surface,
                     const MeshEdges& edges, int most_listed);

}  // namespace plumb::audit
