// The result of an audit as JSON.
#pragma once

#include <string>

#include "audit/audit.h"
#include "audit/audit_subject.h"

namespace plumb::audit {

/// One JSON object, schema "plumb.audit/1", ending in a line feed. Everything but the member
/// `timing` has the same bytes on every machine and number of threads. Infinite and missing numbers
/// are null.
///
/// verdict     "held", "broken" or "none"; beside "none" stands no_verdict, the reason
/// claims      each with its own verdict: "held", "broken" or "not measured", where `measured` and
///             `holds` are null; `worst` is where it comes nearest to its bound or is farthest over
/// offenders   places, what broke first: `breaks` is the broken claim's measure, null where none is
///             broken there; `pixel` is null out of view, `triangle` where no mesh has one
/// errors      null where it is not measured: of a surface without a mesh, and of a truth that is
/// no
///             heightfield, which has pixel_nearest_m, vertex_m and their reverses instead
/// topology    all counts; `offenders` has the first places of each kind
std::string audit_json(const AuditResult& result, const AuditSubject& subject);

}  // namespace plumb::audit
