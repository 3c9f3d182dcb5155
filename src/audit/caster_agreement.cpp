#include "audit/caster_agreement.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace plumb::audit {

CasterAgreement compare_casters(const HitImage& a, const HitImage& b, const Camera& camera,
                                double allowed_px) {
  require(a.width_px == b.width_px && a.height_px == b.height_px,
          "two pictures must be of one size, got {} x {} and {} x {}", a.width_px, a.height_px,
          b.width_px, b.height_px);
  constexpr std::size_t kMostListed = 100;
  const double gamma = std::max(camera.gamma_h, camera.gamma_v);
  CasterAgreement result;
  result.rays = static_cast<std::int64_t>(a.size());
  for (std::size_t pixel = 0; pixel < a.size(); ++pixel) {
    const bool hit_a = a.hit(pixel), hit_b = b.hit(pixel);
    if (!hit_a && !hit_b) continue;
    double apart = kNoHit;
    if (hit_a && hit_b) {
      ++result.both_hit;
      const glm::dvec3 d = a.from_eye_m[pixel] - b.from_eye_m[pixel];
      apart = std::sqrt(glm::dot(d, d)) * gamma / std::min(a.depth_m[pixel], b.depth_m[pixel]);
      result.largest_px = std::max(result.largest_px, apart);
      if (apart <= allowed_px) {
        result.other_triangle += a.primitive[pixel] != b.primitive[pixel];
        continue;
      }
      ++result.apart;
    } else {
      ++result.one_misses;
    }
    if (result.listed.size() < kMostListed) {
      const auto width = static_cast<std::size_t>(a.width_px);
      result.listed.push_back(
          {static_cast<int>(pixel % width), static_cast<int>(pixel / width), apart});
    }
  }
  return result;
}

}  // namespace plumb::audit
