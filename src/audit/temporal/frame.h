// A frame of a path: what was drawn, and for which camera.
#pragma once

#include <memory>
#include <utility>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "reference/mesh_nearest.h"

namespace plumb::audit::temporal {

/// Keeps the surface, whose mesh is shared, for the frames that follow.
class Frame {
 public:
  Frame(DrawnSurface surface, const Camera& camera)
      : surface_(std::move(surface)), camera_(camera) {}

  const DrawnSurface& surface() const { return surface_; }
  const Camera& camera() const { return camera_; }
  bool has_mesh() const { return surface_.mesh != nullptr; }
  /// Made when first asked for, so not by several threads at once; null without a triangle.
  const reference::MeshNearest* nearest() const {
    if (!nearest_ && has_mesh() && !surface_.mesh->triangles.empty())
      nearest_ = std::make_shared<const reference::MeshNearest>(*surface_.mesh);
    return nearest_.get();
  }
  /// Nothing of the two differs but the camera.
  bool draws_as(const Frame& other) const {
    return has_mesh() && surface_.mesh == other.surface_.mesh;
  }
  bool has_levels() const { return !surface_.triangle_lod.empty() || !surface_.patches.empty(); }
  /// Of a triangle, or a patch of a surface without a mesh; -1 where there are no levels.
  int level_of(std::uint32_t primitive) const {
    if (primitive < surface_.triangle_lod.size()) return surface_.triangle_lod[primitive];
    if (surface_.patches.empty()) return -1;
    return surface_.patches[static_cast<std::size_t>(patch_at(primitive))].lod;
  }
  /// The patch that a primitive belongs to; -1 where there are none.
  int patch_at(std::uint32_t primitive) const {
    if (surface_.patches.empty()) return -1;
    return has_mesh() ? patch_of(surface_, primitive) : static_cast<int>(primitive);
  }

 private:
  DrawnSurface surface_;
  Camera camera_;
  mutable std::shared_ptr<const reference::MeshNearest> nearest_;
};

}  // namespace plumb::audit::temporal
