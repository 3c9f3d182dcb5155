// Pieces of an audit's result as JSON, for the files that write one: not for public headers.
#pragma once

#include <glm/vec3.hpp>

#include <nlohmann/json.hpp>

#include "audit/audit.h"

namespace plumb::audit {

using Json = nlohmann::ordered_json;

/// Null where it is infinite or missing.
Json number_json(double value);
Json triple_json(const glm::dvec3& v);
Json offender_json(const Offender& offender);

/// Adds `claims`, `patch_claims`, `errors`, `samples`, `coverage`, `topology`, `registration` and
/// `cost`, as audit_json.h has them.
void add_measurements(Json& to, const AuditResult& result);

}  // namespace plumb::audit
