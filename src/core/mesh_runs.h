// Boxes around runs of a mesh's triangles, for a mesh that many cameras see.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/box.h"
#include "core/camera.h"
#include "core/triangle_mesh.h"

namespace plumb {

/// Runs of kTriangles consecutive triangles (the last may be shorter), each with its box and the
/// chunks of kVertices consecutive vertices that it uses. What lies outside a camera's view can be
/// left out by the run, its vertices unread.
///
/// Meshes whose consecutive triangles lie together have small boxes; others lose nothing but time.
class MeshRuns {
 public:
  static constexpr std::uint32_t kTriangles = 512;
  static constexpr std::uint32_t kVertices = 64;

  /// Throws std::invalid_argument if a triangle names a vertex that is not there or a vertex is not
  /// finite. Holds about a quarter of a byte a triangle.
  explicit MeshRuns(std::shared_ptr<const TriangleMesh> mesh);

  std::size_t count() const { return boxes_.size(); }
  const std::shared_ptr<const TriangleMesh>& mesh() const { return mesh_; }
  /// Relative to the mesh's origin.
  const Box& box(std::size_t run) const { return boxes_[run]; }
  std::span<const std::uint32_t> vertex_chunks(std::size_t run) const {
    return {chunks_.data() + first_chunk_[run], first_chunk_[run + 1] - first_chunk_[run]};
  }

  /// One entry a run: zero only if no point of it is in view (may_be_in_view).
  std::vector<std::uint8_t> in_view(const Camera& camera) const;

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::vector<Box> boxes_;
  std::vector<std::size_t> first_chunk_;  // of each run; one more at the end
  std::vector<std::uint32_t> chunks_;
};

}  // namespace plumb
