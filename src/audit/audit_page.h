// The result of an audit for people: pictures, heat maps, and one page that holds them all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/audit_subject.h"
#include "audit/truth_terms.h"
#include "core/drawn_surface.h"

namespace plumb::audit {

/// Writes into `folder`, which is made if it is not there:
///   report.html       the page, self-contained
///   audit.json        audit_json(result, subject)
///   truth.png, drawn.png, difference.png
///   pixel-error.png   heat map with its legend, in pixels; the claimed bound is the scale's end;
///                     of heightfields alone
///   nearest-error.png the same for the nearest point, if measured
///   reverse-error.png from the truth to the nearest point drawn, of other truths alone
///   coverage.png      demands in grey, defects in colour
///   triangles.png     each triangle outlined, coloured by level
///   summary.png       truth, drawn and pixel error side by side
/// Returns the files' names. Throws InputError if one cannot be written; what stood there before is
/// then still there.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const AuditResult& result, const AuditSubject& subject,
                                      const DrawnSurface& surface, const TruthTerms& truth);

/// "812 triangles, 40 slices, 446 vertices, 3000 fragments".
std::string drawn_text(const Cost& cost);

}  // namespace plumb::audit
