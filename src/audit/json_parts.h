// Pieces of an audit's result as JSON text, for the files that hold one.
#pragma once

#include <string>

#include "audit/audit.h"

namespace plumb::audit {

/// An object with `claims`, `patch_claims`, `errors`, `samples`, `coverage`, `topology`,
/// `registration` and `cost`, in this order, as audit_json.h has them.
std::string measurements_json(const AuditResult& result);

/// The list `offenders` of the first `most` of them.
std::string offenders_json(const AuditResult& result, std::size_t most = ~std::size_t{0});

}  // namespace plumb::audit
