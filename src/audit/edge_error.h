// The error between the height samples: where drawn edges cross true ones.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "audit/mesh_edges.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/claim.h"
#include "core/triangle_mesh.h"

namespace plumb::audit {

/// The sample error between the samples: at the drawn mesh's vertices and wherever a drawn edge
/// crosses an edge of the truth. With the samples themselves these are all places where the
/// distance of two piecewise linear surfaces can be largest. Vertical triangles (skirts) lie over
/// no place.
struct EdgeErrors {
  double max_m = 0.0;
  double max_px = 0.0;                     // of places in the frustum
  double pixels_per_metre = 0.0;           // on screen, where that is
  glm::dvec3 worst_m{0.0}, worst_px{0.0};  // places on the truth, relative to the terrain's origin
  std::uint32_t triangle_m = kNoPrimitive, triangle_px = kNoPrimitive;
  std::int64_t places = 0;  // looked at, each once
};
EdgeErrors edge_errors(const HeightfieldTruth& truth, const TriangleMesh& mesh,
                       const MeshEdges& edges, const Camera& camera);

/// One of those places.
struct EdgePlace {
  double error = 0.0;    // metres or pixels
  glm::dvec3 at_m{0.0};  // on the truth, relative to the terrain's origin
  std::uint32_t triangle = kNoPrimitive;
};

struct EdgePlacesOver {
  std::int64_t count = 0;
  std::vector<EdgePlace> worst;  // worst first, of equals the first by the edges' order
};

/// Counts the places that edge_errors looks at whose error exceeds `bound`, and gives the `most`
/// worst of them.
///
///   (1) In pixels, only places in the frustum count; a bound below zero counts all of them.
///   (2) The count is above zero if and only if edge_errors' maximum exceeds the bound.
EdgePlacesOver edge_places_over(const HeightfieldTruth& truth, const TriangleMesh& mesh,
                                const MeshEdges& edges, const Camera& camera,
                                const Tolerance& bound, std::size_t most);

}  // namespace plumb::audit
