// A user's limit on popping, judged.
#pragma once

#include "audit/audit.h"
#include "audit/temporal/frame_change.h"
#include "audit/truth_terms.h"

namespace plumb::audit::temporal {

/// Adds a limit's verdict to a frame's claims, behind those of the frame, and its worst place to
/// the offenders. Where no popping was measured, as in a path's first frame, it neither holds nor
/// is broken.
///
/// limit  of "popping", in pixels
/// A measurement breaks the bound if it exceeds it by more than rounding explains: three times the
/// truth's slack, one for the true point and one for each frame, at the largest scale of the
/// picture.
void add_popping_limit(AuditResult& audited, const Limit& limit, const FrameChange& change,
                       const TruthTerms& truth, const Camera& camera);

}  // namespace plumb::audit::temporal
