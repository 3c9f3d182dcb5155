#include "audit/frame_memory.h"

#include <fmt/format.h>

#include "core/memory.h"

namespace plumb::audit {

void require_frame_memory(const Camera& camera, std::int64_t bytes_per_pixel) {
  require_memory(bytes_per_pixel * camera.width_px * camera.height_px,
                 fmt::format("a picture of {} x {} pixels", camera.width_px, camera.height_px));
}

}  // namespace plumb::audit
