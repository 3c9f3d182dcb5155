// How far a picture's points, and a mesh's vertices, lie from the nearest point of another mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "audit/vertex_distances.h"
#include "core/camera.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"
#include "reference/mesh_nearest.h"

namespace plumb::audit {

/// A mesh that is asked for nearest points. Keeps references to both.
struct NearestSide {
  const TriangleMesh& mesh;
  const std::optional<reference::MeshNearest>& nearest;  // of `mesh`; nothing if it has no triangle
  double slack_m = 0.0;  // distances that rounding explains count as none: mesh_slack_m
};

/// One entry a pixel, NaN where nothing is seen, +inf where the other mesh has no triangle.
struct NearestMaps {
  std::vector<float> px;                // between the projections
  std::vector<float> metres;            // between the points
  std::vector<std::uint32_t> triangle;  // of the other mesh; kNoPrimitive where there is none
};

/// From each point that a picture shows.
///
/// seen  in world coordinates through `camera`
/// hint  a triangle of the other mesh for each pixel, looked at first; it changes no result
///
///   (1) A distance of at most to.slack_m and drawn_point_slack_m is 0, in pixels as well.
NearestMaps nearest_maps(const HitImage& seen, const Camera& camera, const NearestSide& to,
                         std::span<const std::uint32_t> hint);

/// From each vertex of `mesh` that a triangle uses, in view or not.
///
/// origin_m  the terrain's, which the worst place is relative to
/// `worst_triangle` is the nearest one of the other mesh.
VertexDistances vertex_distances(const TriangleMesh& mesh, const NearestSide& to,
                                 const glm::dvec3& origin_m);

}  // namespace plumb::audit
