#include "audit/temporal/change_maps.h"

#include <limits>

namespace plumb::audit::temporal {

ChangeMaps::ChangeMaps(std::size_t pixels)
    : px(pixels, std::numeric_limits<float>::quiet_NaN()),
      m(px),
      now(pixels, kNoPrimitive),
      before(now),
      earlier(now) {}

void set_moved(ChangeMaps& maps, const std::vector<Moved>& moved) {
  for (std::size_t pixel = 0; pixel < moved.size(); ++pixel) {
    const Moved& here = moved[pixel];
    if (here.px < 0.0) continue;
    maps.px[pixel] = static_cast<float>(here.px);
    maps.m[pixel] = static_cast<float>(here.m);
    if (!(here.px > maps.max_px)) continue;
    maps.max_px = here.px;
    maps.max_m = here.m;
    maps.worst_pixel = static_cast<std::int64_t>(pixel);
  }
}

bool in_view(const Camera& camera, const glm::dvec3& point_m) {
  const glm::dvec3 view = to_view(camera, point_m);
  if (!(view.z >= camera.near_m && view.z <= camera.far_m)) return false;
  const glm::dvec2 pixel = view_to_pixel(camera, view);
  return pixel.x >= 0.0 && pixel.x <= camera.width_px && pixel.y >= 0.0 &&
         pixel.y <= camera.height_px;
}

}  // namespace plumb::audit::temporal
