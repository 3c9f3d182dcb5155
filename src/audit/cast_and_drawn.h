// The truth cast, the surface drawn, both held against each other: the same for every kind of
// truth.
#pragma once

#include <utility>

#include "audit/audit.h"
#include "audit/surface_picture.h"
#include "core/stopwatch.h"

namespace plumb::audit {

/// caster  the truth's, which casts whole frames
/// truth   what audit_picture() of its kind takes
template <class Truth, class Caster>
AuditResult audit_cast_and_drawn(const Truth& truth, const Caster& caster,
                                 const DrawnSurface& surface, const Camera& camera,
                                 const AuditOptions& options) {
  Stopwatch watch;
  HitImage true_hits = caster.cast_frame(camera);
  const double truth_s = watch.lap_s();
  SurfacePicture picture = picture_of(surface, camera);
  const double raster_s = watch.lap_s();
  AuditResult result = audit_picture(truth, std::move(true_hits), surface, std::move(picture.image),
                                     camera, options);
  result.cost.fragments = picture.fragments;
  result.times.truth_s = truth_s;
  result.times.raster_s = raster_s;
  return result;
}

}  // namespace plumb::audit
