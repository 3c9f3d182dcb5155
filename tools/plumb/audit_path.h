// What an audit tells of a path as a whole, gathered frame by frame.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/audit_subject.h"
#include "audit/temporal/path_page.h"
#include "audit/temporal/path_watch.h"
#include "text_table.h"

namespace plumb::tool {

/// Frames of a path by their verdicts.
struct FrameCount {
  std::size_t held = 0, broken = 0, none = 0;
  std::string why_none;  // of the first such frame

  void add(const audit::AuditResult& result);
  /// Frames without a verdict are passed over, unless all are.
  audit::Verdict verdict() const;
  std::string text() const;
};

/// Takes the limits of popping out of `limits`. Throws InputError if there is one and the camera is
/// a single frame.
std::vector<audit::Limit> take_popping_limits(std::vector<audit::Limit>& limits,
                                              std::size_t frames);

/// Gathers the frames of a path.
class PathReport {
 public:
  /// Keeps references to what `truth` is made of.
  PathReport(const audit::TruthTerms& truth, std::vector<audit::Limit> limits, audit::Band band);

  /// Measures what changed since the last frame and judges the limits, which adds to `result`'s
  /// claims.
  void measure(audit::AuditResult& result, const DrawnSurface& surface, const Camera& camera);
  /// Takes down the frame just measured; with `json`, that of it too.
  void add(const audit::AuditResult& result, const audit::AuditSubject& subject, bool json);

  const FrameCount& count() const { return count_; }
  std::string json() const;
  /// The table of all frames, and what is worst.
  std::string text() const;
  /// Writes the path's own page. `command` makes the whole path again.
  std::vector<std::string> write(const std::string& folder, const std::string& command) const;

 private:
  audit::TruthTerms truth_;
  std::vector<audit::Limit> limits_;
  audit::temporal::PathWatch watch_;
  audit::temporal::FrameChange change_;  // of the frame just measured
  FrameCount count_;
  std::vector<audit::temporal::PathRow> rows_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<std::string> json_;
  audit::AuditSubject subject_;  // of the last frame
};

}  // namespace plumb::tool
