// What judging coverage takes, whatever the truth is.
#pragma once

#include <algorithm>

#include "audit/coverage.h"
#include "audit/neighbourhood.h"
#include "core/camera.h"
#include "core/parallel.h"

namespace plumb::audit {

inline constexpr int kRaysPerPixel = 4;     // along each axis, where a defect is looked at again
inline constexpr int kMostRays = 64;        // and at most so many along each axis of the band
inline constexpr int kMostReach = 64;       // pixels
inline constexpr double kSameDepth = 1e-6;  // relative; two casts of one point
inline constexpr double kNearlySameDepth = 1e-3;  // relative; neighbouring rays of one slope

/// Where truth rays go through around a pixel: on a square of `reach` pixels each way.
struct RayGrid {
  double width;
  int rays;  // along each axis

  explicit RayGrid(double reach)
      : width(2.0 * reach + 1.0),
        rays(std::min(static_cast<int>(width * kRaysPerPixel), kMostRays)),
        reach_(reach) {}
  /// Image point of ray k along an axis, around pixel `at` of it.
  double place(int at, int k) const { return at - reach_ + (k + 0.5) / rays * width; }

 private:
  double reach_;
};

/// Casts truth rays around a pixel until one is as wanted.
template <class Caster, class Wanted>
bool any_ray_around(const Caster& caster, const Camera& camera, int x, int y, double reach,
                    const Wanted& wanted) {
  const RayGrid grid(reach);
  for (int b = 0; b < grid.rays; ++b) {
    for (int a = 0; a < grid.rays; ++a) {
      if (wanted(caster.cast(caster.camera_ray(camera, grid.place(x, a), grid.place(y, b)))))
        return true;
    }
  }
  return false;
}

/// The band in whole pixels, from 1 to kMostReach.
int band_in_pixels(const Band& band);

/// Fills in demands and defects, each pixel judged by itself: judge(x, y, neighbourhood of the
/// truth) -> DefectKind. Pixels that are set aside are neither demanded nor judged.
template <class Judge>
Coverage judged_coverage(const HitImage& true_hits, int band_px,
                         const std::vector<std::uint8_t>& set_aside, const Judge& judge) {
  Coverage coverage;
  coverage.band_px = band_px;
  coverage.demand.assign(true_hits.size(), Demand::Either);
  coverage.defects.assign(true_hits.size(), DefectKind::None);
  const Neighbourhoods bands = neighbourhoods(true_hits, band_px);
  parallel_for(true_hits.height_px, 1, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < true_hits.width_px; ++x) {
      const std::size_t pixel = true_hits.index(x, y);
      if (!set_aside.empty() && set_aside[pixel]) continue;
      const Neighbourhood n = bands[pixel];
      if (n.all_hit()) coverage.demand[pixel] = Demand::Terrain;
      if (n.all_miss()) coverage.demand[pixel] = Demand::Sky;
      coverage.defects[pixel] = judge(x, y, n);
    }
  });
  return coverage;
}

/// Counts demands and defects, and lists the first `most_listed` of a kind with their patches.
void count_and_list(Coverage& coverage, const HitImage& true_hits, const HitImage& drawn,
                    const DrawnSurface& surface, int most_listed);

}  // namespace plumb::audit
