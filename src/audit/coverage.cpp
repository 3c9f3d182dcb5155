#include "audit/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/coverage_parts.h"
#include "audit/rays_around.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

// Looks again, between the pixels, at what the pixels' centres hold against a picture.
class SecondLook {
 public:
  SecondLook(const HeightfieldTruth& truth, const HitImage& true_hits, const HitImage& drawn,
             const Camera& camera, const Band& band, int radius)
      : truth_(truth),
        true_hits_(true_hits),
        drawn_(drawn),
        local_(relative_to(camera, truth.field().world_origin_m())),
        band_(band),
        walk_(truth, camera, band),
        rays_(truth, camera),
        radius_(radius),
        drawn_around_(neighbourhoods(drawn, radius + 1)) {}

  DefectKind judge(int x, int y, const Neighbourhood& n) const {
    const std::size_t pixel = drawn_.index(x, y);
    const bool hit = drawn_.hit(pixel);
    // What is missing or too much over the whole band and more is no matter of detail between
    // pixels.
    const bool at_large = band_.metres == 0.0 &&
                          (hit ? drawn_around_[pixel].all_hit() : drawn_around_[pixel].all_miss());
    if (n.all_hit() && !hit) {
      if (at_large) return DefectKind::Hole;
      const bool sky = rays_.any_passes(x, y, reach_at(true_hits_.from_eye_m[pixel]), kInfinity);
      return sky || may_pass(pixel, beyond(pixel)) ? DefectKind::None : DefectKind::Hole;
    }
    if (n.all_miss() && hit) {
      if (at_large) return DefectKind::Overshoot;
      // Truth that is seen edge on is hit by no ray; displaced, it shows.
      if (walk_.keeps(local_.eye_m + drawn_.from_eye_m[pixel])) return DefectKind::None;
      const bool land = rays_.any_hits(x, y, reach_at(drawn_.from_eye_m[pixel]));
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
    if (counterpart_is_visible(local_.eye_m + drawn_.from_eye_m[pixel])) return false;
    if (may_pass(pixel, local_.eye_m + drawn_.from_eye_m[pixel])) return false;
    return !rays_.any_passes(x, y, reach_at(true_hits_.from_eye_m[pixel]),
                             depth * (1.0 - kNearlySameDepth));
  }

  // True if a surface that keeps to the band may let the pixel's ray pass, where the truth does
  // not. Lowered, it lets the ray run on to `end`, or through a void or beyond the terrain. Raised,
  // it lets it slip below its rim, where it came over a void or from outside, or begins below it:
  // back from where the truth was met, at the near plane.
  bool may_pass(std::size_t pixel, const glm::dvec3& end) const {
    const glm::dvec3& ray = true_hits_.from_eye_m[pixel];
    const glm::dvec3 met = local_.eye_m + ray;
    const glm::dvec3 begin = local_.eye_m + ray * (local_.near_m / true_hits_.depth_m[pixel]);
    return walk_.is_free(met, end, BandWalk::Side::Below) ||
           walk_.is_free(met, begin, BandWalk::Side::Above);
  }

  // Where the pixel's ray leaves the picture: beyond the terrain, or at the far plane.
  glm::dvec3 beyond(std::size_t pixel) const {
    const terrain::Heightfield& field = truth_.field();
    const glm::dvec3& ray = true_hits_.from_eye_m[pixel];
    const double across = std::sqrt(ray.x * ray.x + ray.y * ray.y),
                 extent = field.cell_columns() * field.dx_m + field.cell_rows() * field.dy_m,
                 length = across > 0.0 ? 1.0 + extent / across : 1.0;
    return local_.eye_m + ray * std::min(length, local_.far_m / true_hits_.depth_m[pixel]);
  }

  // How far around a pixel truth rays are cast, pixels: as far as the surface may have moved there.
  double reach_at(const glm::dvec3& from_eye_m) const {
    const double reach = radius_;
    if (!(band_.metres > 0.0)) return reach;
    const double moved =
        screen_displacement_px(local_, local_.eye_m + from_eye_m, kUp, band_.metres);
    return std::clamp(std::ceil(moved) + 1.0, reach, static_cast<double>(kMostReach));
  }

  // True if the truth above or below the drawn point is seen from the eye: then the surface is
  // displaced, not torn.
  bool counterpart_is_visible(const glm::dvec3& drawn_point) const {
    const double height = truth_.height_at(drawn_point.x, drawn_point.y);
    if (std::isnan(height)) return false;
    const glm::dvec3 place{drawn_point.x, drawn_point.y, height};
    const glm::dvec3 view = to_view(local_, place);
    if (!(view.z > local_.near_m)) return false;
    const reference::Ray ray{local_.eye_m, place - local_.eye_m, local_.near_m / view.z, 2.0};
    const reference::RayHit hit = truth_.caster.cast(ray);
    return hit && hit.t >= 1.0 - kSameDepth;
  }

  const HeightfieldTruth& truth_;
  const HitImage& true_hits_;
  const HitImage& drawn_;
  Camera local_;
  Band band_;
  BandWalk walk_;
  RaysAround rays_;
  int radius_;
  Neighbourhoods drawn_around_;
};

}  // namespace

Coverage coverage_of(const HeightfieldTruth& truth, const HitImage& true_hits,
                     const HitImage& drawn, const Camera& camera, const DrawnSurface& surface,
                     const Band& band, const std::vector<std::uint8_t>& set_aside,
                     int most_listed) {
  const int band_px = band_in_pixels(band);
  const SecondLook look(truth, true_hits, drawn, camera, band, band_px);
  Coverage coverage =
      judged_coverage(true_hits, band_px, set_aside,
                      [&](int x, int y, const Neighbourhood& n) { return look.judge(x, y, n); });
  count_and_list(coverage, true_hits, drawn, surface, most_listed);
  return coverage;
}

}  // namespace plumb::audit
