#include "audit/solid_coverage.h"

#include <algorithm>
#include <cmath>

#include "audit/apart_on_screen.h"
#include "audit/coverage_parts.h"
#include "audit/mesh_band_walk.h"
#include "audit/pixel_scale.h"

namespace plumb::audit {
namespace {

class SolidLook {
 public:
  SolidLook(const MeshTruth& truth, const HitImage& true_hits, const HitImage& drawn,
            const Camera& camera, const NearestSide& to_drawn, const Band& band)
      : truth_(truth),
        true_hits_(true_hits),
        drawn_(drawn),
        camera_(camera),
        local_(relative_to(camera, to_drawn.mesh.origin_m)),
        to_drawn_(to_drawn),
        band_(band),
        walk_(truth, camera, band),
        radius_(band_in_pixels(band)),
        drawn_around_(neighbourhoods(drawn, radius_ + 1)) {}

  DefectKind judge(int x, int y, const Neighbourhood& n) const {
    const std::size_t pixel = drawn_.index(x, y);
    const bool hit = drawn_.hit(pixel);
    // What is missing or too much over the whole band and more is no matter of detail between
    // pixels.
    const bool at_large = band_.metres == 0.0 &&
                          (hit ? drawn_around_[pixel].all_hit() : drawn_around_[pixel].all_miss());
    if (n.all_hit() && !hit) {
      if (at_large) return DefectKind::Hole;
      const bool sky = any_ray(x, y, true_hits_, [](const reference::RayHit& ray) { return !ray; });
      return sky || is_displaced_past(true_hits_.from_eye_m[pixel]) ? DefectKind::None
                                                                    : DefectKind::Hole;
    }
    if (n.all_miss() && hit) {
      if (at_large) return DefectKind::Overshoot;
      // Truth that is seen edge on is hit by no ray; displaced, it shows.
      if (walk_.keeps(drawn_.from_eye_m[pixel])) return DefectKind::None;
      const bool land = any_ray(
          x, y, drawn_, [](const reference::RayHit& ray) { return static_cast<bool>(ray); });
      return land ? DefectKind::None : DefectKind::Overshoot;
    }
    return hit && n.all_hit() && is_seen_through(x, y, n) ? DefectKind::SeeThrough
                                                          : DefectKind::None;
  }

 private:
  bool is_seen_through(int x, int y, const Neighbourhood& n) const {
    const std::size_t pixel = drawn_.index(x, y);
    const double depth = drawn_.depth_m[pixel];
    if (depth <= n.deepest * (1.0 + kSameDepth)) return false;
    if (has_drawn_nearby(local_.eye_m + true_hits_.from_eye_m[pixel])) return false;
    if (counterpart_is_visible(camera_.eye_m + drawn_.from_eye_m[pixel])) return false;
    return !any_ray(x, y, true_hits_, [&](const reference::RayHit& ray) {
      return !ray || ray.t >= depth * (1.0 - kNearlySameDepth);
    });
  }

  // True if what the truth shows is drawn within the band, and may let the ray pass there.
  bool is_displaced_past(const glm::dvec3& ray) const {
    return has_drawn_nearby(local_.eye_m + ray) && walk_.may_pass(ray);
  }

  bool has_drawn_nearby(const glm::dvec3& true_point) const {
    if (!to_drawn_.nearest) return false;
    const reference::NearestPoint found = to_drawn_.nearest->nearest(true_point);
    return found.distance_m <= band_.metres + to_drawn_.slack_m ||
           apart_on_screen(local_, true_point, found.point_m) <= radius_;
  }

  // True if the truth nearest to the drawn point is seen from the eye: then the surface is
  // displaced, not torn.
  bool counterpart_is_visible(const glm::dvec3& drawn_point) const {
    if (!truth_.nearest()) return false;
    const glm::dvec3 origin = truth_.mesh().origin_m, eye = camera_.eye_m - origin,
                     place = truth_.nearest()->nearest(drawn_point - origin).point_m;
    const double depth = glm::dot(place - eye, camera_.forward);
    if (!(depth > camera_.near_m)) return false;
    const reference::RayHit hit =
        truth_.caster().cast({eye, place - eye, camera_.near_m / depth, 2.0});
    return hit && hit.t >= 1.0 - kSameDepth;
  }

  // As far as the surface may have moved around what `image` shows there.
  template <class Wanted>
  bool any_ray(int x, int y, const HitImage& image, const Wanted& wanted) const {
    double reach = radius_;
    if (band_.metres > 0.0) {
      const double moved =
          band_.metres * pixels_per_metre(camera_, image.from_eye_m[image.index(x, y)]);
      reach = std::clamp(std::ceil(moved) + 1.0, reach, static_cast<double>(kMostReach));
    }
    return any_ray_around(truth_.caster(), camera_, x, y, reach, wanted);
  }

  const MeshTruth& truth_;
  const HitImage& true_hits_;
  const HitImage& drawn_;
  const Camera& camera_;
  Camera local_;
  const NearestSide& to_drawn_;
  Band band_;
  MeshBandWalk walk_;
  int radius_;
  Neighbourhoods drawn_around_;
};

}  // namespace

Coverage solid_coverage_of(const MeshTruth& truth, const HitImage& true_hits, const HitImage& drawn,
                           const Camera& camera, const DrawnSurface& surface,
                           const NearestSide& to_drawn, const Band& band, int most_listed) {
  const SolidLook look(truth, true_hits, drawn, camera, to_drawn, band);
  Coverage coverage =
      judged_coverage(true_hits, band_in_pixels(band), {},
                      [&](int x, int y, const Neighbourhood& n) { return look.judge(x, y, n); });
  count_and_list(coverage, true_hits, drawn, surface, most_listed);
  return coverage;
}

}  // namespace plumb::audit
