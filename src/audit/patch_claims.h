// What patches claim of their own samples, against what was measured.
#pragma once

#include <cstddef>
#include <vector>

#include "audit/audit.h"
#include "audit/offenders.h"

namespace plumb::audit {

/// Judges the surface's claims of scope Patch: fills in `patch_claims` and `patch_claims_broken`.
///
/// returns  those that a report shows: the broken ones, worst first, or else the tightest; at most
///          `most_listed`. Violations are samples; a patch without any has nothing measured.
/// Throws std::invalid_argument if a patch claims anything but its sample error in metres, or does
/// not exist.
std::vector<ClaimResult> check_patch_claims(AuditResult& result, const HeightfieldTruth& truth,
                                            const DrawnSurface& surface,
                                            const OffenderFinder& finder, int most_listed);

}  // namespace plumb::audit
