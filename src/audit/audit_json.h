// The result of an audit as JSON.
#pragma once

#include <string>

#include "audit/audit.h"
#include "audit/audit_subject.h"

namespace plumb::audit {

/// One JSON object, schema "plumb.audit/1", ending in a line feed. Everything but the member
/// `timing` has the same bytes on every machine and number of threads. Infinite and missing numbers
/// are null.
std::string audit_json(const AuditResult& result, const AuditSubject& subject);

}  // namespace plumb::audit
