// Many truth rays around a pixel, between the pixels' centres, of a heightfield.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "audit/truth.h"
#include "core/camera.h"
#include "reference/camera_rays.h"

namespace plumb::audit {

/// Asks what any_ray_around() of coverage_parts.h asks, of the same rays, and gives the same
/// answers, but looks at few of them one by one. Serves any number of threads at once; keeps
/// references to what it is made of.
class RaysAround {
 public:
  RaysAround(const HeightfieldTruth& truth, const Camera& camera);

  /// True if a ray of the square of `reach` pixels (whole, at most kMostReach) each way around
  /// (x, y) meets the truth.
  bool any_hits(int x, int y, double reach) const;
  /// True if one misses it, or meets it at a view depth of `depth_m` (+inf: misses only) or more.
  bool any_passes(int x, int y, double reach, double depth_m) const;

 private:
  struct Square;
  template <class Wanted>
  bool any_of_few(const Square& square, const Wanted& wanted) const;
  template <class Counts, class Wanted>
  bool any_of_all(const Square& square, const Counts& counts, const Wanted& wanted) const;
  float latest_hit(int x, int y) const;
  float found_latest_hit(int x, int y) const;

  reference::CameraRays rays_;
  bool has_voids_;
  // Of each pixel and those around the picture, when first asked for: all its rays hit by this view
  // depth (+inf: not known); below 0: not looked at yet.
  mutable std::once_flag once_;
  mutable std::unique_ptr<std::atomic<float>[]> latest_;
};

}  // namespace plumb::audit
