#include "audit/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "audit/neighbourhood.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr int kRaysPerPixel = 4;  // along each axis, where a defect is looked at again
constexpr int kMostRays = 64;     // and at most so many along each axis of the band
constexpr int kMostReach = 64;    // pixels
constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr double kSameDepth = 1e-6;        // relative; two casts of one point
constexpr double kNearlySameDepth = 1e-3;  // relative; neighbouring rays of one slope

// Looks again, between the pixels, at what the pixels' centres hold against a picture.
class SecondLook {
 public:
  SecondLook(const HeightfieldTruth& truth, const HitImage& true_hits, const HitImage& drawn,
             const Camera& camera, const Band& band, int radius)
      : truth_(truth),
        true_hits_(true_hits),
        drawn_(drawn),
        camera_(camera),
        local_(relative_to(camera, truth.field().world_origin_m())),
        band_(band),
        walk_(truth, camera, band),
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
      const bool sky = any_ray_around(x, y, true_hits_.from_eye_m[pixel],
                                      [](const reference::RayHit& ray) { return !ray; });
      return sky || may_pass(pixel, beyond(pixel)) ? DefectKind::None : DefectKind::Hole;
    }
    if (n.all_miss() && hit) {
      if (at_large) return DefectKind::Overshoot;
      const bool land =
          any_ray_around(x, y, drawn_.from_eye_m[pixel],
                         [](const reference::RayHit& ray) { return static_cast<bool>(ray); });
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
    return !any_ray_around(x, y, true_hits_.from_eye_m[pixel], [&](const reference::RayHit& ray) {
      return !ray || ray.t >= depth * (1.0 - kNearlySameDepth);
    });
  }

  // True if a surface that keeps to the band may let the pixel's ray pass, where the truth does
  // not. Lowered, it lets the ray run on to `end`, or through a void or beyond the terrain. Raised,
  // it lets it slip below its rim, where it came over a void or from outside.
  bool may_pass(std::size_t pixel, const glm::dvec3& end) const {
    const glm::dvec3 met = local_.eye_m + true_hits_.from_eye_m[pixel];
    return walk_.follow(met, end, BandWalk::Side::Below) != BandWalk::Way::Blocked ||
           walk_.follow(met, local_.eye_m, BandWalk::Side::Above) == BandWalk::Way::Open;
  }

  // A point of the pixel's ray beyond the terrain.
  glm::dvec3 beyond(std::size_t pixel) const {
    const terrain::Heightfield& field = truth_.field();
    const glm::dvec3& ray = true_hits_.from_eye_m[pixel];
    const double across = std::sqrt(ray.x * ray.x + ray.y * ray.y),
                 extent = field.cell_columns() * field.dx_m + field.cell_rows() * field.dy_m;
    return local_.eye_m + ray * (across > 0.0 ? 1.0 + extent / across : 1.0);
  }

  // Casts truth rays around a pixel, as far as the surface may have moved there, until one is as
  // wanted.
  template <class Wanted>
  bool any_ray_around(int x, int y, const glm::dvec3& from_eye_m, const Wanted& wanted) const {
    double reach = radius_;
    if (band_.metres > 0.0) {
      const double moved =
          screen_displacement_px(local_, local_.eye_m + from_eye_m, kUp, band_.metres);
      reach = std::clamp(std::ceil(moved) + 1.0, reach, static_cast<double>(kMostReach));
    }
    const double width = 2.0 * reach + 1.0;
    const int rays = std::min(static_cast<int>(width * kRaysPerPixel), kMostRays);
    for (int b = 0; b < rays; ++b) {
      for (int a = 0; a < rays; ++a) {
        const double px = x - reach + (a + 0.5) / rays * width,
                     py = y - reach + (b + 0.5) / rays * width;
        if (wanted(truth_.caster.cast(truth_.caster.camera_ray(camera_, px, py)))) return true;
      }
    }
    return false;
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
  const Camera& camera_;
  Camera local_;
  Band band_;
  BandWalk walk_;
  int radius_;
  Neighbourhoods drawn_around_;
};

// The two patches that most pixels around show.
void name_patches(CoverageDefect& defect, const HitImage& drawn, const DrawnSurface& surface) {
  std::map<int, int> seen;
  for (int b = std::max(0, defect.y - 2); b <= std::min(drawn.height_px - 1, defect.y + 2); ++b) {
    for (int a = std::max(0, defect.x - 2); a <= std::min(drawn.width_px - 1, defect.x + 2); ++a) {
      const std::uint32_t primitive = drawn.primitive[drawn.index(a, b)];
      if (primitive != kNoPrimitive) ++seen[patch_of(surface, primitive)];
    }
  }
  std::array<int, 2> count{0, 0};
  for (const auto& [patch, pixels] : seen) {
    if (pixels > count[0]) {
      defect.patch_b = defect.patch_a;
      count[1] = count[0];
      defect.patch_a = patch;
      count[0] = pixels;
    } else if (pixels > count[1]) {
      defect.patch_b = patch;
      count[1] = pixels;
    }
  }
}

void count_and_list(Coverage& coverage, const HitImage& true_hits, const HitImage& drawn,
                    const DrawnSurface& surface, int most_listed) {
  for (int y = 0; y < drawn.height_px; ++y) {
    for (int x = 0; x < drawn.width_px; ++x) {
      const std::size_t pixel = drawn.index(x, y);
      const Demand demand = coverage.demand[pixel];
      ++(demand == Demand::Terrain ? coverage.must_be_terrain
         : demand == Demand::Sky   ? coverage.must_be_sky
                                   : coverage.either);
      const DefectKind kind = coverage.defects[pixel];
      if (kind == DefectKind::None) continue;
      auto& count = kind == DefectKind::Hole        ? coverage.holes
                    : kind == DefectKind::Overshoot ? coverage.overshoots
                                                    : coverage.see_through;
      if (++count > most_listed) continue;
      CoverageDefect defect{kind, x, y, true_hits.depth_m[pixel], drawn.depth_m[pixel]};
      name_patches(defect, drawn, surface);
      coverage.listed.push_back(defect);
    }
  }
}

}  // namespace

const char* name_of(DefectKind kind) {
  switch (kind) {
    case DefectKind::None:
      return "none";
    case DefectKind::Hole:
      return "hole";
    case DefectKind::Overshoot:
      return "overshoot";
    case DefectKind::SeeThrough:
      return "see-through";
  }
  return "?";
}

Coverage coverage_of(const HeightfieldTruth& truth, const HitImage& true_hits,
                     const HitImage& drawn, const Camera& camera, const DrawnSurface& surface,
                     const Band& band, const std::vector<std::uint8_t>& set_aside,
                     int most_listed) {
  Coverage coverage;
  coverage.band_px =
      static_cast<int>(std::clamp(std::ceil(band.pixels), 1.0, static_cast<double>(kMostReach)));
  coverage.demand.assign(drawn.size(), Demand::Either);
  coverage.defects.assign(drawn.size(), DefectKind::None);
  const SecondLook look(truth, true_hits, drawn, camera, band, coverage.band_px);
  const Neighbourhoods bands = neighbourhoods(true_hits, coverage.band_px);
  parallel_for(drawn.height_px, 1, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < drawn.width_px; ++x) {
      const std::size_t pixel = drawn.index(x, y);
      if (!set_aside.empty() && set_aside[pixel]) continue;
      const Neighbourhood n = bands[pixel];
      if (n.all_hit()) coverage.demand[pixel] = Demand::Terrain;
      if (n.all_miss()) coverage.demand[pixel] = Demand::Sky;
      coverage.defects[pixel] = look.judge(x, y, n);
    }
  });
  count_and_list(coverage, true_hits, drawn, surface, most_listed);
  return coverage;
}

}  // namespace plumb::audit
