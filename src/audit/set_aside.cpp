#include "audit/set_aside.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>

#include "audit/drawn_point.h"
#include "core/parallel.h"

namespace plumb::audit {

namespace {

bool has_voids(const terrain::Heightfield& field) {
  return parallel_ordered_reduce(
      field.rows(), 16, false,
      [&](std::int64_t begin, std::int64_t end, bool found) {
        for (std::int64_t j = begin; j < end && !found; ++j) {
          for (int i = 0; i < field.columns(); ++i)
            found = found || field.is_void(i, static_cast<int>(j));
        }
        return found;
      },
      std::logical_or<>());
}

// True if a ray in this direction meets the triangle from below.
bool meets_underside(const HeightfieldTruth& truth, std::uint32_t triangle,
                     const glm::dvec3& direction) {
  return glm::dot(reference::triangle_normal(truth.field(), truth.diagonal(), triangle),
                  direction) > 0.0;
}

}  // namespace

std::vector<std::uint8_t> rays_below_ground(const HeightfieldTruth& truth,
                                            const HitImage& true_hits, const HitImage& drawn,
                                            const Camera& camera, const Band& band) {
  const glm::dvec3 eye = camera.eye_m - truth.field().world_origin_m();
  const bool with_voids = has_voids(truth.field());
  std::vector<std::uint8_t> set_aside(drawn.size(), 0);
  const BandWalk walk(truth, camera, band);
  // Whether the ground was crossed on the way to a point below it, and not beside a rim.
  const auto came_through = [&](const glm::dvec3& point, const glm::dvec3& ray) {
    const reference::RayHit out = truth.caster.cast({point, -ray, 0.0, 1.0});
    return out && meets_underside(truth, out.triangle, -ray) &&
           walk.follow(point - out.t * ray, eye, BandWalk::Side::Above) != BandWalk::Way::Open;
  };
  parallel_for(static_cast<std::int64_t>(drawn.size()), 1024, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (true_hits.hit(pixel) &&
        meets_underside(truth, true_hits.primitive[pixel], true_hits.from_eye_m[pixel])) {
      set_aside[pixel] = 1;
      return;
    }
    const bool before = drawn.depth_m[pixel] < true_hits.depth_m[pixel];
    if (!drawn.hit(pixel) || (!before && !with_voids)) return;
    const glm::dvec3& ray = drawn.from_eye_m[pixel];
    const glm::dvec3 point = eye + ray;
    const double slack_m = truth.slack_m + drawn_point_slack_m(largest_coordinate(ray));
    if (!(truth.height_at(point.x, point.y) - point.z > slack_m)) return;
    set_aside[pixel] =
        before || (walk.is_beyond(point, BandWalk::Side::Below) && !came_through(point, ray));
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
