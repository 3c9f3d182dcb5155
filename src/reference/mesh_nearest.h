// The point of a mesh that is nearest to another point.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "reference/nearest_point.h"

namespace plumb::reference {

/// What is asked of a mesh.
struct NearestQuery {
  glm::dvec3 point_m;
  double max_radius_m = std::numeric_limits<double>::infinity();
  std::uint32_t near_triangle = kNoPrimitive;  // looked at first
};

/// Nearest points on a mesh: Embree's tree of boxes proposes triangles, double decides.
///
///   (1) No other point of the mesh is nearer by more than a few roundings of the coordinates;
///       triangles at equal distance: the lowest index.
///   (2) A function of point and mesh alone: the same bits on every instruction set and number of
///       threads.
/// Points are relative to the mesh's origin, so that UTM coordinates cost no digits.
class MeshNearest {
 public:
  /// Keeps a reference to the mesh. Throws std::invalid_argument unless its corners are vertices
  /// and its vertices finite, InputError if memory does not suffice.
  explicit MeshNearest(const TriangleMesh& mesh);
  explicit MeshNearest(TriangleMesh&&) = delete;
  ~MeshNearest();
  MeshNearest(MeshNearest&&) noexcept;
  MeshNearest& operator=(MeshNearest&&) noexcept;

  /// Points farther than max_radius_m are not looked for. `near_triangle`, if given, is looked at
  /// first: one that is near makes the search short, and none changes what it finds. Throws
  /// std::invalid_argument unless the point is finite and max_radius_m >= 0.
  NearestPoint nearest(const glm::dvec3& point_m,
                       double max_radius_m = std::numeric_limits<double>::infinity(),
                       std::uint32_t near_triangle = kNoPrimitive) const;
  /// The same for up to kTogether points that lie side by side: one walk through the tree for all
  /// of them.
  void nearest_together(std::span<const NearestQuery> queries, std::span<NearestPoint> found) const;
  static constexpr std::size_t kTogether = 32;
  /// The same for many points, in parallel.
  std::vector<NearestPoint> nearest(
      std::span<const glm::dvec3> points_m,
      double max_radius_m = std::numeric_limits<double>::infinity()) const;

 private:
  struct Scene;
  std::unique_ptr<const Scene> scene_;
};

}  // namespace plumb::reference
