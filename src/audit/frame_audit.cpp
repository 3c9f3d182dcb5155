#include "audit/frame_audit.h"

#include <algorithm>
#include <utility>

#include "audit/solid_audit.h"
#include "audit/surface_picture.h"
#include "core/stopwatch.h"

namespace plumb::audit {

Band band_of(const Method& method, const std::string& variant, const Tolerance& tolerance) {
  Band band;
  const std::vector<std::string>& sizes = method.size_variants;
  if (std::find(sizes.begin(), sizes.end(), variant) == sizes.end())
    (tolerance.unit == Unit::Pixel ? band.pixels : band.metres) = tolerance.value;
  return band;
}

HitImage cast_truth(const TruthTerms& truth, const Camera& camera) {
  return truth.mesh() != nullptr ? truth.mesh()->caster().cast_frame(camera)
                                 : truth.heights()->caster.cast_frame(camera);
}

AuditResult audit_frame(const TruthTerms& truth, HitImage true_hits, const DrawnSurface& surface,
                        const Camera& camera, const AuditOptions& options) {
  Stopwatch watch;
  SurfacePicture picture = picture_of(surface, camera);
  const double raster_s = watch.lap_s();
  AuditResult result = truth.mesh() != nullptr
                           ? audit_picture(*truth.mesh(), std::move(true_hits), surface,
                                           std::move(picture.image), camera, options)
                           : audit_picture(*truth.heights(), std::move(true_hits), surface,
                                           std::move(picture.image), camera, options);
  result.cost.fragments = picture.fragments;
  result.times.raster_s = raster_s;
  return result;
}

AuditResult audit_frame(const TruthTerms& truth, const DrawnSurface& surface, const Camera& camera,
                        const AuditOptions& options) {
  Stopwatch watch;
  HitImage true_hits = cast_truth(truth, camera);
  const double truth_s = watch.lap_s();
  AuditResult result = audit_frame(truth, std::move(true_hits), surface, camera, options);
  result.times.truth_s = truth_s;
  return result;
}

}  // namespace plumb::audit
