// A verdict in words: what it is, why, and where it was broken.
#pragma once

#include <string>
#include <vector>

#include "audit/audit.h"

namespace plumb::audit {

/// A number as tables show it: four digits, "inf", "-" for none.
std::string short_number(double value);
/// The same with its unit behind it: "0.98 px"; a count has none.
std::string with_unit(double value, Unit unit);

/// One sentence: what the verdict is, and why.
std::string verdict_sentence(const AuditResult& result);

/// "held", "BROKEN" or "not measured".
const char* verdict_word(const ClaimResult& claim);

/// The worst place of each broken claim of the frame, or else of the worst broken patch: "worst:
/// surface-error 14.33 m at pixel (3, 4), world (1, 2, 3), triangle 5, patch 6 (name)".
///
///   (1) Nothing if no claim is broken; one line for a claim and a limit of the same measure.
std::vector<std::string> worst_lines(const AuditResult& result);

}  // namespace plumb::audit
