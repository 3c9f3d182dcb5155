#include "audit_path.h"

#include <fmt/format.h>

#include <utility>

#include "audit/temporal/path_json.h"
#include "audit/temporal/popping_limit.h"
#include "audit/verdict_text.h"
#include "audit_text.h"
#include "common_options.h"
#include "core/check.h"

namespace plumb::tool {

namespace temporal = audit::temporal;

void FrameCount::add(const audit::AuditResult& result) {
  const audit::Verdict verdict = result.verdict();
  ++(verdict == audit::Verdict::Held ? held : verdict == audit::Verdict::Broken ? broken : none);
  if (none == 1 && why_none.empty()) why_none = result.no_verdict;
}

audit::Verdict FrameCount::verdict() const {
  if (broken > 0) return audit::Verdict::Broken;
  return held > 0 ? audit::Verdict::Held : audit::Verdict::None;
}

std::string FrameCount::text() const {
  const std::size_t frames = held + broken + none;
  if (none == frames) return fmt::format("No verdict of any frame: {}.", why_none);
  std::string text = fmt::format("{} of {} frames keep every claim", held, frames);
  if (none > 0) text += fmt::format("; {} without a verdict: {}", none, why_none);
  return text + ".";
}

std::vector<audit::Limit> take_popping_limits(std::vector<audit::Limit>& limits,
                                              std::size_t frames) {
  std::vector<audit::Limit> popping, others;
  for (audit::Limit& limit : limits)
    (limit.measure == "popping" ? popping : others).push_back(std::move(limit));
  if (!popping.empty() && frames < 2)
    input_error(
        "--limit popping: it is measured between the frames of a path, and this is one frame "
        "(--camera flyover and --camera zoom are paths)");
  limits = std::move(others);
  return popping;
}

PathReport::PathReport(const audit::TruthTerms& truth, std::vector<audit::Limit> limits,
                       audit::Band band)
    : truth_(truth), limits_(std::move(limits)), watch_(truth, {band, true}) {}

void PathReport::measure(audit::AuditResult& result, const DrawnSurface& surface,
                         const Camera& camera) {
  change_ = watch_.next(surface, camera, result);
  for (const audit::Limit& limit : limits_)
    temporal::add_popping_limit(result, limit, change_, truth_, camera);
}

void PathReport::add(const audit::AuditResult& result, const audit::AuditSubject& subject,
                     bool json) {
  count_.add(result);
  rows_.push_back(temporal::path_row(rows_.size() + 1, result, change_));
  const temporal::PathRow& row = rows_.back();
  cells_.push_back(frame_row(row.frame, result));
  cells_.back().push_back(row.popping_px ? audit::short_number(*row.popping_px) : "-");
  cells_.back().push_back(row.popping_p99_px ? audit::short_number(*row.popping_p99_px) : "-");
  cells_.back().push_back(row.flicker_pixels ? std::to_string(*row.flicker_pixels) : "-");
  if (json) json_.push_back(temporal::frame_json(result, subject, change_));
  subject_ = subject;
}

std::string PathReport::json() const { return temporal::path_json(json_); }

std::string PathReport::text() const {
  std::vector<TextColumn> columns = frame_columns();
  columns.insert(columns.end(),
                 {{"popping, px", true}, {"99 %", true}, {"flickering pixels", true}});
  return text_table(columns, cells_) +
         fmt::format("\n{}\n{}\n", temporal::path_sentence(rows_), count_.text());
}

std::vector<std::string> PathReport::write(const std::string& folder,
                                           const std::string& command) const {
  temporal::PathPage page;
  page.subject = subject_;
  page.subject.command = command;
  page.verdict = count_.verdict();
  page.sentence = count_.text();
  for (const audit::Limit& limit : limits_) page.limit_px = limit.bound;
  for (const temporal::PathRow& row : rows_)
    page.addresses.push_back(frame_name(row.frame) + "/report.html");
  return temporal::write_path_report(folder, rows_, page, json());
}

}  // namespace plumb::tool
