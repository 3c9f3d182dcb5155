#include "audit/temporal/popping_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/drawn_point.h"
#include "audit/over_bound.h"
#include "audit/pixel_scale.h"
#include "audit/settled_claim.h"

namespace plumb::audit::temporal {
namespace {

double slack_px(const AuditResult& audited, const TruthTerms& truth, const Camera& camera,
                double measured) {
  double reach = 0.0, scale = 0.0;
  for (std::size_t pixel = 0; pixel < audited.true_hits.size(); ++pixel) {
    if (!audited.true_hits.hit(pixel)) continue;
    const glm::dvec3& ray = audited.true_hits.from_eye_m[pixel];
    reach = std::max(reach, largest_coordinate(ray));
    scale = std::max(scale, pixels_per_metre(camera, ray));
  }
  const double projecting = 64.0 * std::numeric_limits<double>::epsilon();
  return (3.0 * truth.slack_m() + drawn_point_slack_m(reach)) * scale +
         (std::isfinite(measured) ? projecting * measured : 0.0);
}

Offender offender_of(const PoppedPlace& place) {
  Offender worst{"popping", place.px, Unit::Pixel, place.x, place.y};
  worst.world_m = place.world_m;
  worst.patch = place.after.patch;
  worst.patch_name = place.after.patch_name;
  worst.triangle = place.after.primitive;
  return worst;
}

}  // namespace

void add_popping_limit(AuditResult& audited, const Limit& limit, const FrameChange& change,
                       const TruthTerms& truth, const Camera& camera) {
  ClaimResult claim;
  claim.claim.bound = limit.bound;
  claim.claim.unit = limit.unit;
  claim.is_limit = true;
  claim.label = limit.measure;
  claim.is_measured = change.popping && change.popping->pixels.count > 0;
  if (claim.is_measured) {
    const Popping& popping = *change.popping;
    claim.measured = popping.max_px;
    claim.slack = slack_px(audited, truth, camera, popping.max_px);
    if (popping.worst) claim.worst = offender_of(*popping.worst);
    if (claim.worst && !audited.of_mesh) claim.worst->triangle = kNoPrimitive;
  }
  settle(claim);
  if (claim.is_broken()) {
    const double bound = claim.claim.bound + claim.slack;
    claim.violations = std::max<std::int64_t>(1, count_above(change.popping->px, bound));
    claim.worst->breaks = claim.label;
    claim.places = {*claim.worst};
    audited.offenders.insert(audited.offenders.begin(), *claim.worst);
  }
  const auto of_patches =
      std::find_if(audited.claims.begin(), audited.claims.end(),
                   [](const ClaimResult& other) { return other.claim.scope == Scope::Patch; });
  audited.claims.insert(of_patches, std::move(claim));
}

}  // namespace plumb::audit::temporal
