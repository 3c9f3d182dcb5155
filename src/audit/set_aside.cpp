#include "audit/set_aside.h"

#include <glm/geometric.hpp>

#include "core/parallel.h"

namespace plumb::audit {

std::vector<std::uint8_t> rays_below_ground(const HeightfieldTruth& truth,
                                            const HitImage& true_hits, const HitImage& drawn,
                                            const Camera& camera) {
  const glm::dvec3 eye = camera.eye_m - truth.field().world_origin_m();
  std::vector<std::uint8_t> set_aside(drawn.size(), 0);
  parallel_for(static_cast<std::int64_t>(drawn.size()), 4096, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (true_hits.hit(pixel)) {
      const glm::dvec3 normal =
          reference::triangle_normal(truth.field(), truth.diagonal(), true_hits.primitive[pixel]);
      if (glm::dot(normal, true_hits.from_eye_m[pixel]) > 0.0) set_aside[pixel] = 1;
    }
    if (!drawn.hit(pixel) || drawn.depth_m[pixel] >= true_hits.depth_m[pixel]) return;
    const glm::dvec3 point = eye + drawn.from_eye_m[pixel];
    if (truth.height_at(point.x, point.y) - point.z > truth.slack_m) set_aside[pixel] = 1;
  });
  return set_aside;
}

HitImage without(HitImage picture, const std::vector<std::uint8_t>& set_aside) {
  for (std::size_t pixel = 0; pixel < picture.size(); ++pixel) {
    if (!set_aside[pixel]) continue;
    picture.depth_m[pixel] = kNoHit;
    picture.from_eye_m[pixel] = glm::dvec3(0.0);
    picture.primitive[pixel] = kNoPrimitive;
  }
  return picture;
}

}  // namespace plumb::audit
