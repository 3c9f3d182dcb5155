#include "audit/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

constexpr int kRaysPerPixel = 4;           // along each axis, where a defect is looked at again
constexpr double kSameDepth = 1e-6;        // relative; two casts of one point
constexpr double kNearlySameDepth = 1e-3;  // relative; neighbouring rays of one slope

// What the truth shows within the band around a pixel: its least and greatest depth, kNoHit for
// sky.
struct Neighbourhood {
  double nearest, deepest;
  bool all_hit() const { return deepest < kNoHit; }
  bool all_miss() const { return nearest == kNoHit; }
};

Neighbourhood join(Neighbourhood a, Neighbourhood b) {
  return {std::min(a.nearest, b.nearest), std::max(a.deepest, b.deepest)};
}

// Along rows first, then along columns: 2 (2 radius + 1) looks a pixel.
std::vector<Neighbourhood> neighbourhoods(const HitImage& image, int radius) {
  std::vector<Neighbourhood> along_rows(image.size()), all(image.size());
  parallel_for(image.height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width_px; ++x) {
      Neighbourhood n{kNoHit, 0.0};
      for (int a = std::max(0, x - radius); a <= std::min(image.width_px - 1, x + radius); ++a) {
        const double depth = image.depth_m[image.index(a, y)];
        n = join(n, {depth, depth});
      }
      along_rows[image.index(x, y)] = n;
    }
  });
  parallel_for(image.height_px, 8, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < image.width_px; ++x) {
      Neighbourhood n{kNoHit, 0.0};
      for (int b = std::max(0, y - radius); b <= std::min(image.height_px - 1, y + radius); ++b) {
        n = join(n, along_rows[image.index(x, b)]);
      }
      all[image.index(x, y)] = n;
    }
  });
  return all;
}

// Casts truth rays all over the band around a pixel until one satisfies `wanted(hit)`.
template <class Wanted>
bool any_ray_between(const HeightfieldTruth& truth, const Camera& camera, int x, int y, int radius,
                     const Wanted& wanted) {
  const int rays = (2 * radius + 1) * kRaysPerPixel;
  for (int b = 0; b < rays; ++b) {
    for (int a = 0; a < rays; ++a) {
      const double px = x - radius + (a + 0.5) / kRaysPerPixel,
                   py = y - radius + (b + 0.5) / kRaysPerPixel;
      if (wanted(truth.caster.cast(truth.caster.camera_ray(camera, px, py)))) return true;
    }
  }
  return false;
}

// True if the truth above or below the drawn point is seen from the eye: then the surface is
// displaced, not torn.
bool counterpart_is_visible(const HeightfieldTruth& truth, const Camera& local,
                            const glm::dvec3& drawn_point) {
  const double height = truth.height_at(drawn_point.x, drawn_point.y);
  if (std::isnan(height)) return false;
  const glm::dvec3 view = to_view(local, {drawn_point.x, drawn_point.y, height});
  if (!(view.z > local.near_m)) return false;
  reference::Ray ray{local.eye_m, glm::dvec3(drawn_point.x, drawn_point.y, height) - local.eye_m,
                     0.0, 2.0};
  ray.t_min = local.near_m / view.z;
  const reference::RayHit hit = truth.caster.cast(ray);
  return hit && hit.t >= 1.0 - kSameDepth;
}

DefectKind judge(const HeightfieldTruth& truth, const HitImage& true_hits, const HitImage& drawn,
                 const Camera& camera, const Camera& local, int x, int y, int radius,
                 const Neighbourhood& n) {
  const std::size_t pixel = drawn.index(x, y);
  if (n.all_hit() && !drawn.hit(pixel)) {
    const bool sky_between = any_ray_between(truth, camera, x, y, radius,
                                             [](const reference::RayHit& hit) { return !hit; });
    return sky_between ? DefectKind::None : DefectKind::Hole;
  }
  if (n.all_miss() && drawn.hit(pixel)) {
    const bool land_between =
        any_ray_between(truth, camera, x, y, radius,
                        [](const reference::RayHit& hit) { return static_cast<bool>(hit); });
    return land_between ? DefectKind::None : DefectKind::Overshoot;
  }
  if (!drawn.hit(pixel) || !true_hits.hit(pixel) || n.deepest == kNoHit) return DefectKind::None;
  const double depth = drawn.depth_m[pixel];
  if (depth <= n.deepest * (1.0 + kSameDepth)) return DefectKind::None;
  if (counterpart_is_visible(truth, local, local.eye_m + drawn.from_eye_m[pixel]))
    return DefectKind::None;
  const bool as_deep =
      any_ray_between(truth, camera, x, y, radius, [&](const reference::RayHit& hit) {
        return !hit || hit.t >= depth * (1.0 - kNearlySameDepth);
      });
  return as_deep ? DefectKind::None : DefectKind::SeeThrough;
}

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
                     double tolerance_px, int most_listed) {
  Coverage coverage;
  coverage.band_px = static_cast<int>(std::clamp(std::ceil(tolerance_px), 1.0, 64.0));
  coverage.demand.assign(drawn.size(), Demand::Either);
  coverage.defects.assign(drawn.size(), DefectKind::None);
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const std::vector<Neighbourhood> bands = neighbourhoods(true_hits, coverage.band_px);
  parallel_for(drawn.height_px, 1, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < drawn.width_px; ++x) {
      const std::size_t pixel = drawn.index(x, y);
      const Neighbourhood& n = bands[pixel];
      if (n.all_hit()) coverage.demand[pixel] = Demand::Terrain;
      if (n.all_miss()) coverage.demand[pixel] = Demand::Sky;
      coverage.defects[pixel] =
          judge(truth, true_hits, drawn, camera, local, x, y, coverage.band_px, n);
    }
  });
  count_and_list(coverage, true_hits, drawn, surface, most_listed);
  return coverage;
}

}  // namespace plumb::audit
