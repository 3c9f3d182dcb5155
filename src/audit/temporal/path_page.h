// A path's audit for people: a table, a chart along the path, and a page that leads to its frames.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/audit_subject.h"
#include "audit/temporal/frame_change.h"

namespace plumb::audit::temporal {

/// A frame of a path in figures.
struct PathRow {
  std::size_t frame = 0;  // from 1
  Verdict verdict = Verdict::None;
  double error_px = 0.0;   // largest vertical error; of truths that are no heightfields nearest
  std::int64_t holes = 0;  // see-through pixels among them
  std::int64_t triangles = 0;
  std::int64_t fragments = 0;
  bool of_slices = false;                            // its cost is told in fragments
  std::optional<double> popping_px, popping_p99_px;  // none of the first frame
  std::int64_t over_1px = 0;
  std::optional<std::int64_t> flicker_pixels, flicker_patches;
  std::string worst;  // where it popped most, in words; empty if nothing did
};

PathRow path_row(std::size_t frame, const AuditResult& audited, const FrameChange& change);

/// "popping at most 3.2 px, in frame 17 at pixel (3, 4), level 2 to 1 (NAME); levels flicker in 4
/// frames, at most 120 pixels of frame 5".
std::string path_sentence(const std::vector<PathRow>& rows);

/// Error, popping, flicker and cost one below the other along the path, as SVG.
///
/// tolerance, limit  marked in the panels of error and popping, where there is one in pixels
std::string path_chart(const std::vector<PathRow>& rows, const std::string& title,
                       std::optional<double> tolerance_px, std::optional<double> limit_px);

struct PathPage {
  AuditSubject subject;  // of any of its frames; `command` makes the whole path again
  Verdict verdict = Verdict::None;
  std::string sentence;                // the verdict in words
  std::optional<double> limit_px;      // of popping, if there is one
  std::vector<std::string> addresses;  // of the frames' own pages, a row each
};

/// Writes into `folder`, which is made if it is not there:
///   report.html  the page, self-contained: verdict, chart, the worst frames and all frames, with
///                links to their own pages
///   path.svg     path_chart
///   audit.json   `json`
/// Returns the files' names. Throws InputError if one cannot be written.
std::vector<std::string> write_path_report(const std::filesystem::path& folder,
                                           const std::vector<PathRow>& rows, const PathPage& page,
                                           const std::string& json);

}  // namespace plumb::audit::temporal
