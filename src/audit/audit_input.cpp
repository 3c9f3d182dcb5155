#include "audit/audit_input.h"

#include <stdexcept>

#include "core/check.h"

namespace plumb::audit {

void require_consistent(const HitImage& true_hits, const DrawnSurface& surface,
                        const HitImage& drawn, const Camera& camera) {
  for (const HitImage* image : {&true_hits, &drawn}) {
    require(image->width_px == camera.width_px && image->height_px == camera.height_px,
            "a picture must be {} x {} pixels as the camera says, got {} x {}", camera.width_px,
            camera.height_px, image->width_px, image->height_px);
  }
  for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel) {
    if (drawn.hit(pixel) && drawn.primitive[pixel] >= surface.primitive_count()) {
      throw std::invalid_argument(
          "a picture must name triangles of the surface's mesh, or patches where it has none");
    }
  }
  require(surface.triangle_lod.empty() || surface.triangle_lod.size() == surface.primitive_count(),
          "triangle_lod must have an entry for each of {} triangles, got {}",
          surface.primitive_count(), surface.triangle_lod.size());
  require(surface.kinds.size() <= DrawnSurface::kMostKinds,
          "a surface has at most {} kinds of patches, got {}", DrawnSurface::kMostKinds,
          surface.kinds.size());
  for (const Patch& patch : surface.patches) {
    require(surface.kinds.empty() ||
                (patch.kind >= 0 && patch.kind < static_cast<int>(surface.kinds.size())),
            "a patch must be of one of {} kinds, got {}", surface.kinds.size(), patch.kind);
  }
}

}  // namespace plumb::audit
