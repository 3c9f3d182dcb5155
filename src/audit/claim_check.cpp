#include "audit/claim_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "audit/claim_measures.h"
#include "audit/patch_claims.h"

namespace plumb::audit {
namespace {

// In the words of somebody who asks why; empty if there is one.
std::string no_surface(const TruthTerms& truth) {
  if (truth.mesh() != nullptr)
    return truth.mesh()->mesh().triangles.empty() ? "the terrain's stacks have no surface" : "";
  const terrain::Heightfield& field = truth.field();
  std::int64_t voids = 0;
  bool has_surface = false;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      voids += field.is_void(i, j);
      has_surface = has_surface || reference::exists_at(field, truth.heights()->diagonal(),
                                                        i * field.dx_m, j * field.dy_m);
    }
  }
  if (has_surface) return "";
  return fmt::format("the terrain has no surface ({} x {} samples, {} of them void)",
                     field.columns(), field.rows(), voids);
}

std::string why_nothing_is_measured(const AuditResult& result, const TruthTerms& truth,
                                    const ClaimMeasures& measures) {
  if (const std::string none = no_surface(truth); !none.empty()) return none;
  if (!measures.anything_in_view()) {
    return result.pixels_set_aside > 0 ? "all that is in view of this camera is set aside"
                                       : "nothing of the terrain is in view of this camera";
  }
  return "nothing that is claimed or limited could be measured";
}

void name_what_breaks(ClaimResult& claim) {
  if (!claim.is_broken()) return;
  if (claim.worst) claim.worst->breaks = claim.label;
  for (Offender& place : claim.places) place.breaks = claim.label;
}

}  // namespace

void check_claims(AuditResult& result, const TruthTerms& truth, const DrawnSurface& surface,
                  const Camera& camera, const AuditOptions& options) {
  const ClaimMeasures measures(result, truth, surface, camera, options);
  std::vector<ClaimResult>& claims = result.claims;
  for (const Claim& claim : surface.claims) {
    if (claim.scope == Scope::Frame)
      claims.push_back(measures.of_claim(claim, name_of(claim.measure)));
  }
  claims.push_back(
      measures.of_claim({Measure::Coverage, 0.0, Unit::Count}, name_of(Measure::Coverage)));
  for (const Limit& limit : options.limits) claims.push_back(measures.of_limit(limit));
  const bool is_measured = std::any_of(claims.begin(), claims.end(),
                                       [](const ClaimResult& claim) { return claim.is_measured; });
  if (!is_measured) result.no_verdict = why_nothing_is_measured(result, truth, measures);
  if (truth.heights() != nullptr) {  // patches claim what their samples are off
    for (ClaimResult& claim : check_patch_claims(result, *truth.heights(), surface,
                                                 measures.finder(), options.most_listed))
      claims.push_back(std::move(claim));
  }
  for (ClaimResult& claim : claims) name_what_breaks(claim);
  result.offenders = measures.finder().worst(claims, measures.most_places());
}

}  // namespace plumb::audit
