// The one number of an audit that a scene is about.
#pragma once

#include "audit/audit.h"
#include "audit/stability/failure_scene.h"
#include "audit/truth_terms.h"

namespace plumb::audit::stability {

/// asked    the unit of the tolerance that was asked for
/// result   the audit of `surface`, seen through `camera`
double value_of(Reading reading, Unit asked, const TruthTerms& truth, const DrawnSurface& surface,
                const AuditResult& result, const Camera& camera);

}  // namespace plumb::audit::stability
