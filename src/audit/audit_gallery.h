// The pictures of a report as files and as a viewer of its page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/audit_subject.h"
#include "audit/truth_terms.h"
#include "image/colour_image.h"
#include "report/html_page.h"

namespace plumb::audit {

/// A picture of the report: in the folder as a file, in the page with its note and, for a map, its
/// legend.
struct Shown {
  std::string file, name, note;  // no name: in the folder alone
  image::Rgb8Image picture;
  image::Rgb8Image legend = {};     // stands below it in the page
  image::Rgb8Image in_folder = {};  // in its place in the folder, where not empty
};

/// Truth, drawn, difference, summary, maps of errors, triangles and coverage, as far as they were
/// measured.
std::vector<Shown> gallery(const AuditResult& result, const AuditSubject& subject,
                           const DrawnSurface& surface, const TruthTerms& truth);

/// Writes the pictures into the folder and gives those of the page. Throws InputError if one
/// cannot be written.
report::Viewer write_gallery(const std::filesystem::path& folder, const std::vector<Shown>& gallery,
                             const AuditResult& result);

}  // namespace plumb::audit
