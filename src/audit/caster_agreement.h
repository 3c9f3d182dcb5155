// Whether two casters see the same: how the auditor itself is audited.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// A pixel on which two casters differ.
struct Disagreement {
  int x = 0, y = 0;
  double apart_px = 0.0;  // |dP| * gamma / depth; +inf where only one hits
};

struct CasterAgreement {
  std::int64_t rays = 0, both_hit = 0;
  std::int64_t one_misses = 0;  // one hits and the other does not
  std::int64_t apart = 0;       // both hit, farther apart than `allowed_px`
  std::int64_t other_triangle =
      0;                    // both hit the same place and name different triangles: ties at edges
  double largest_px = 0.0;  // of the places that both hit
  std::vector<Disagreement> listed;  // of the first two kinds, row by row, at most 100

  bool agrees() const { return one_misses == 0 && apart == 0; }
};

/// Both hits lie on one ray, so their distance is measured in the world and scaled to pixels at
/// their depth.
CasterAgreement compare_casters(const HitImage& a, const HitImage& b, const Camera& camera,
                                double allowed_px = 1e-3);

}  // namespace plumb::audit
