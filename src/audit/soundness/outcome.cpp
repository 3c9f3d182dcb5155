#include "audit/soundness/outcome.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "audit/audit.h"
#include "audit/frame_audit.h"
#include "audit/method_truth.h"
#include "audit/verdict_text.h"
#include "core/check.h"
#include "terrain/terrain_source.h"

namespace plumb::audit::soundness {
namespace {

AuditResult audited(const MethodTable& table, const Scene& scene) {
  const Method& method = find_method(table, scene.method);
  const MethodChoice choice = resolved_choice(method, scene.choice);
  AuditOptions options;
  options.most_listed = 1;
  options.band = band_of(method, choice.variant, scene.tolerance);
  const terrain::Heightfield field = terrain::load_terrain(scene.terrain, scene.read);
  const Camera camera = place_camera(scene.camera, field).camera;
  require_drawable(method, field);
  const terrain::Diagonal diagonal =
      scene.diagonal.empty() ? method.truth : terrain::parse_diagonal(scene.diagonal);
  const MethodTruth truth(field, diagonal, table, &method, choice);
  const auto prepared = prepare_method(method, field, choice, scene.tolerance);
  const DrawnSurface surface = prepared->start()->step(camera, scene.tolerance);
  return audit_frame(truth.terms(), surface, camera, options);
}

Ending ending_of(Verdict verdict) {
  return verdict == Verdict::Held     ? Ending::Held
         : verdict == Verdict::Broken ? Ending::Broken
                                      : Ending::None;
}

void note_claims(const AuditResult& result, Outcome& outcome) {
  outcome.promises_nothing = true;
  for (const ClaimResult& claim : result.claims) {
    const bool promises =
        claim.claim.measure != Measure::Coverage && std::isfinite(claim.claim.bound);
    outcome.promises_nothing = outcome.promises_nothing && !promises;
    if (claim.claim.scope != Scope::Frame || !claim.is_measured) continue;
    ++outcome.claims;
    const std::optional<double> tightness = claim.tightness();
    if (!promises || !tightness || !std::isfinite(*tightness)) continue;
    outcome.tightness = std::min(outcome.tightness.value_or(*tightness), *tightness);
  }
  outcome.patch_claims = result.patch_claims;
}

Outcome without_verdict(Ending ending, const char* why) {
  Outcome outcome;
  outcome.ending = ending;
  outcome.reason = why;
  return outcome;
}

// What may be refused, by the words of the line.
struct Refusal {
  const char* words;
  const char* why;
};
constexpr Refusal kStated[] = {
    {"patches need 2 x 2 samples", "patches need 2 x 2 samples"},
    {"has holes alone has no surface", "a terrain of stacks without a stack"},
    {"a terrain without a height has no stacks", "a terrain without a height as stacks"},
};

}  // namespace

const char* name_of(Ending ending) {
  constexpr const char* kNames[] = {"held", "broken", "none", "refused", "failed"};
  return kNames[static_cast<int>(ending)];
}

Outcome outcome_of(const MethodTable& table, const Scene& scene) {
  try {
    const AuditResult result = audited(table, scene);
    Outcome outcome;
    outcome.ending = ending_of(result.verdict());
    outcome.reason = outcome.ending == Ending::None ? result.no_verdict : verdict_sentence(result);
    for (const double depth : result.true_hits.depth_m) outcome.pixels_seen += std::isfinite(depth);
    note_claims(result, outcome);
    return outcome;
  } catch (const InputError& error) {
    return without_verdict(Ending::Refused, error.what());
  } catch (const std::exception& error) {
    return without_verdict(Ending::Failed, error.what());
  }
}

std::string stated_refusal(const Outcome& outcome) {
  if (outcome.ending != Ending::Refused) return "";
  for (const Refusal& refusal : kStated) {
    if (outcome.reason.find(refusal.words) != std::string::npos) return refusal.why;
  }
  return "";
}

bool is_sound(const Outcome& outcome) {
  switch (outcome.ending) {
    case Ending::Held:
      return true;
    case Ending::None:
      return !outcome.reason.empty();
    case Ending::Refused:
      return !stated_refusal(outcome).empty();
    default:
      return false;
  }
}

}  // namespace plumb::audit::soundness
