// Claims and limits against what was measured.
#pragma once

#include <vector>

#include "audit/audit.h"
#include "audit/truth_terms.h"

namespace plumb::audit {

/// Judges every claim of the surface, coverage zero (which every drawn surface claims) and the
/// user's limits. Fills in `claims`, `patch_claims`, `patch_claims_broken`, `offenders` and, where
/// nothing was measured, `no_verdict`; the measures in `result` are there already.
///
/// A measurement breaks a bound if it exceeds it by more than rounding explains: the truth's slack
/// in metres, on screen times the most pixels that a metre spans there.
void check_claims(AuditResult& result, const TruthTerms& truth, const DrawnSurface& surface,
                  const Camera& camera, const AuditOptions& options);

/// Measures that a limit may name, with what they mean.
struct LimitMeasure {
  const char* name;
  Unit unit;
  const char* meaning;
};
const std::vector<LimitMeasure>& limit_measures();

}  // namespace plumb::audit
