// From the vertices of a mesh to the window.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <span>

#include "core/camera.h"
#include "core/mesh_runs.h"
#include "raster/fixed_point.h"

namespace plumb::raster {

/// The planes that triangles are clipped at, in this order: w >= near, then the guard band.
enum ClipPlane { kNear = 0, kLeft, kRight, kTop, kBottom, kClipPlanes };

/// A camera as the rasteriser uses it. Everything is relative to the eye.
struct Projection {
  Camera camera;
  glm::dvec3 origin_from_eye_m{0.0};  // the mesh's origin, so that large coordinates cancel first

  glm::dvec3 from_eye(const glm::dvec3& vertex_m) const { return vertex_m + origin_from_eye_m; }
  /// View coordinates (x, y, w) of a point relative to the eye.
  glm::dvec3 view(const glm::dvec3& from_eye_m) const;
  /// At least 0 on the visible side of a plane; linear in the view coordinates.
  double distance(ClipPlane plane, const glm::dvec3& view_m) const;
  /// Snapped window coordinates of a point that no plane cuts off.
  ScreenVertex to_window(const glm::dvec3& view_m) const;
  /// Bit k is set if plane k cuts the point off.
  unsigned outcode(const glm::dvec3& view_m) const;
};

/// Throws std::invalid_argument unless the camera's numbers are finite, its image 1 to 65536 pixels
/// wide and high, its centre within 2^19 pixels, gammas positive and 0 < near < far.
Projection make_projection(const Camera& camera, const glm::dvec3& mesh_origin_m);

/// `x` of a vertex that must be clipped; its `y` is the outcode.
inline constexpr std::int32_t kClipped = -kLargestCoordinate - 1;

inline unsigned outcode_of(const ScreenVertex& vertex) {
  return vertex.x == kClipped ? static_cast<unsigned>(vertex.y) : 0u;
}

/// Vertices in the window, by their number in the mesh. Nobody writes one before its task.
class ScreenVertices {
 public:
  ScreenVertices() = default;
  explicit ScreenVertices(std::size_t size)
      : vertices_(std::make_unique_for_overwrite<ScreenVertex[]>(size)), size_(size) {}

  std::size_t size() const { return size_; }
  ScreenVertex* data() { return vertices_.get(); }
  const ScreenVertex* data() const { return vertices_.get(); }
  const ScreenVertex* begin() const { return data(); }
  const ScreenVertex* end() const { return data() + size_; }
  const ScreenVertex& operator[](std::size_t k) const { return vertices_[k]; }

 private:
  std::unique_ptr<ScreenVertex[]> vertices_;
  std::size_t size_ = 0;
};

/// Every vertex in the window, in parallel; with `runs`, those chunks that a run with a nonzero
/// entry in `in_view` uses, and the others stay unwritten. Throws std::invalid_argument if one of
/// them is not finite or farther than 1e30 m.
ScreenVertices transform(const Projection& projection, std::span<const glm::dvec3> vertices_m,
                         const MeshRuns* runs = nullptr,
                         std::span<const std::uint8_t> in_view = {});

}  // namespace plumb::raster
