// What moved between two surfaces that are pictures alone: equation (18) of
// docs/algorithms/ground-truth.md.
#include <cmath>

#include "audit/apart_on_screen.h"
#include "audit/drawn_point.h"
#include "audit/set_aside.h"
#include "audit/surface_picture.h"
#include "audit/temporal/change_maps.h"
#include "core/parallel.h"

namespace plumb::audit::temporal {
namespace {

// What a surface made for another frame shows to this one's camera, but for what is set aside.
HitImage judged_picture(const HeightfieldTruth& truth, const HitImage& true_hits,
                        const Frame& frame, const Camera& camera, Band band) {
  HitImage picture = picture_of(frame.surface(), camera).image;
  if (!frame.surface().is_solid) return picture;
  band.metres = std::max(band.metres, frame.surface().out_of_reach_m);
  const auto aside = rays_below_ground(truth, true_hits, picture, camera, band);
  return without(std::move(picture), aside);
}

struct Shown {
  const HeightfieldTruth& truth;
  const Camera& local;

  // The true point above or below what a picture shows; its height is NaN where there is none.
  glm::dvec3 true_point(const HitImage& picture, std::size_t pixel) const {
    glm::dvec3 point = local.eye_m + picture.from_eye_m[pixel];
    point.z = truth.height_at(point.x, point.y);
    return point;
  }
  bool same(const HitImage& a, const HitImage& b, std::size_t pixel) const {
    const glm::dvec3 apart = a.from_eye_m[pixel] - b.from_eye_m[pixel];
    const double reach =
        std::max(largest_coordinate(local.eye_m), largest_coordinate(a.from_eye_m[pixel]));
    return largest_coordinate(apart) <= 2.0 * drawn_point_slack_m(reach);
  }
};

}  // namespace

ChangeMaps shown_moved(const HeightfieldTruth& truth, const AuditResult& audited,
                       const Frames& frames, const Band& band) {
  const glm::dvec3 origin = truth.field().world_origin_m();
  const Camera& camera = frames.now.camera();
  const Camera local = relative_to(camera, origin);
  const Camera before_camera = relative_to(frames.before.camera(), origin);
  const Shown shown{truth, local};
  const HitImage& now = audited.drawn;
  const HitImage before = judged_picture(truth, audited.true_hits, frames.before, camera, band);
  ChangeMaps maps(now.size());
  std::vector<Moved> moved(now.size());
  const auto is_judged = [&](std::size_t pixel) {
    return now.hit(pixel) && (audited.set_aside.empty() || audited.set_aside[pixel] == 0);
  };
  parallel_for(static_cast<std::int64_t>(now.size()), 1024, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (!is_judged(pixel) || !before.hit(pixel)) return;
    const glm::dvec3 to = shown.true_point(now, pixel), from = shown.true_point(before, pixel);
    if (std::isnan(to.z) || std::isnan(from.z) || !in_view(before_camera, to)) return;
    maps.now[pixel] = now.primitive[pixel];
    maps.before[pixel] = before.primitive[pixel];
    moved[pixel] = shown.same(now, before, pixel)
                       ? Moved{0.0, 0.0}
                       : Moved{apart_on_screen(local, from, to), glm::length(to - from)};
  });
  set_moved(maps, moved);
  if (maps.worst_pixel >= 0)
    maps.worst_m = origin + shown.true_point(now, static_cast<std::size_t>(maps.worst_pixel));
  if (frames.earlier == nullptr) return maps;
  const Camera earlier_camera = relative_to(frames.earlier->camera(), origin);
  const HitImage earlier = judged_picture(truth, audited.true_hits, *frames.earlier, camera, band);
  parallel_for(static_cast<std::int64_t>(now.size()), 1024, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (maps.now[pixel] == kNoPrimitive || !earlier.hit(pixel)) return;
    if (in_view(earlier_camera, shown.true_point(now, pixel)))
      maps.earlier[pixel] = earlier.primitive[pixel];
  });
  return maps;
}

}  // namespace plumb::audit::temporal
