#include "audit/temporal/path_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "audit/verdict_text.h"
#include "core/atomic_file.h"
#include "report/html_page.h"
#include "report/scatter_chart.h"

namespace plumb::audit::temporal {
namespace {

constexpr std::size_t kWorstFrames = 5;

std::string level_text(const PoppedPlace& worst) {
  if (worst.before.level < 0 || worst.after.level < 0) return "";
  return worst.before.level == worst.after.level
             ? fmt::format(", level {}", worst.after.level)
             : fmt::format(", level {} to {}", worst.before.level, worst.after.level);
}

std::string worst_text(const Popping& popping) {
  if (!popping.worst) return "";
  const PoppedPlace& worst = *popping.worst;
  std::string text = fmt::format("pixel ({}, {})", worst.x, worst.y) + level_text(worst);
  if (!worst.after.patch_name.empty()) text += fmt::format(" ({})", worst.after.patch_name);
  return text;
}

template <class Figure>
const PathRow* largest(const std::vector<PathRow>& rows, const Figure& figure) {
  const PathRow* worst = nullptr;
  for (const PathRow& row : rows) {
    if (figure(row) > 0 && (worst == nullptr || figure(row) > figure(*worst))) worst = &row;
  }
  return worst;
}

double popped(const PathRow& row) { return row.popping_px.value_or(0.0); }
std::int64_t flickering(const PathRow& row) { return row.flicker_pixels.value_or(0); }

std::string count_text(const std::optional<std::int64_t>& count) {
  return count ? std::to_string(*count) : "-";
}

report::ScatterChart panel(const std::string& y_label) {
  report::ScatterChart chart;
  chart.x_axis = chart.y_axis = report::AxisKind::Linear;
  chart.y_label = y_label;
  chart.series.push_back({"", {}, true});
  return chart;
}

// What has no end has no place on an axis.
void add(report::ScatterChart& chart, const PathRow& row, const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return;
  chart.series.back().points.push_back(
      {static_cast<double>(row.frame), *value,
       fmt::format("frame {}: {} {}", row.frame, chart.y_label, short_number(*value))});
}

void mark(report::ScatterChart& chart, const std::optional<double>& at, const char* label) {
  chart.limit = at;
  if (at) chart.limit_label = label;
}

report::LinkTable frames_table(const std::string& caption, const std::vector<const PathRow*>& rows,
                               const PathPage& page) {
  report::LinkTable table{caption,
                          "frame",
                          {{"verdict"},
                           {"error, px", true},
                           {"popping, px", true},
                           {"99 %", true},
                           {"over 1 px", true},
                           {"flickering", true},
                           {"patches", true},
                           {"holes", true},
                           {"triangles", true},
                           {"where it popped most", false, true}},
                          {}};
  const auto optional_number = [](const std::optional<double>& value) {
    return value ? short_number(*value) : std::string("-");
  };
  for (const PathRow* row : rows) {
    table.rows.push_back(
        {std::to_string(row->frame),
         page.addresses[row->frame - 1],
         {},
         {name_of(row->verdict), short_number(row->error_px), optional_number(row->popping_px),
          optional_number(row->popping_p99_px),
          row->popping_px ? std::to_string(row->over_1px) : "-", count_text(row->flicker_pixels),
          count_text(row->flicker_patches), std::to_string(row->holes),
          std::to_string(row->triangles), row->worst.empty() ? "-" : row->worst},
         row->verdict == Verdict::Broken ? report::RowKind::Bad
         : row->verdict == Verdict::Held ? report::RowKind::Ok
                                         : report::RowKind::Plain});
  }
  return table;
}

// The frames with the largest figures, those of zero left out.
template <class Figure>
std::vector<const PathRow*> worst_frames(const std::vector<PathRow>& rows, const Figure& figure) {
  std::vector<const PathRow*> worst;
  for (const PathRow& row : rows) {
    if (figure(row) > 0) worst.push_back(&row);
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const PathRow* a, const PathRow* b) { return figure(*a) > figure(*b); });
  worst.resize(std::min(worst.size(), kWorstFrames));
  return worst;
}

std::string drawn_by(const AuditSubject& subject) {
  return subject.variant.empty() ? subject.method
                                 : fmt::format("{}, {}", subject.method, subject.variant);
}

std::vector<report::KeyValue> subject_entries(const PathPage& page, std::size_t frames) {
  const AuditSubject& subject = page.subject;
  return {{"terrain", subject.field->provenance.source},
          {"method", drawn_by(subject)},
          {"tolerance", to_text(subject.tolerance)},
          {"path", fmt::format("{}, {} frames of {} x {} px", subject.camera_name, frames,
                               subject.camera.width_px, subject.camera.height_px)},
          {"made again by", subject.command}};
}

std::string page_title(const AuditSubject& subject) {
  return fmt::format("{} at {} along {} on {}", subject.method, to_text(subject.tolerance),
                     subject.camera_name, subject.field->provenance.source);
}

}  // namespace

PathRow path_row(std::size_t frame, const AuditResult& audited, const FrameChange& change) {
  PathRow row;
  row.frame = frame;
  row.verdict = audited.verdict();
  row.error_px = audited.of_heights
                     ? audited.vertical.max
                     : std::max(audited.nearest.forward.max, audited.nearest.reverse.max);
  row.holes = audited.coverage.holes + audited.coverage.see_through;
  row.triangles = audited.cost.triangles;
  row.fragments = audited.cost.fragments;
  row.of_slices = audited.cost.slices > 0;
  if (change.popping && change.popping->pixels.count > 0) {
    row.popping_px = change.popping->max_px;
    row.popping_p99_px = change.popping->pixels.p99;
    row.over_1px = change.popping->over_1px;
    row.worst = worst_text(*change.popping);
  }
  if (change.flicker) {
    row.flicker_pixels = change.flicker->pixels;
    row.flicker_patches = change.flicker->patches;
  }
  return row;
}

std::string path_sentence(const std::vector<PathRow>& rows) {
  const PathRow* popping = largest(rows, popped);
  std::string text = popping == nullptr ? "Nothing pops"
                                        : fmt::format("Popping at most {} px, in frame {} at {}",
                                                      short_number(*popping->popping_px),
                                                      popping->frame, popping->worst);
  if (std::none_of(rows.begin(), rows.end(),
                   [](const PathRow& row) { return row.flicker_pixels.has_value(); }))
    return text + ".";
  const PathRow* flicker = largest(rows, flickering);
  if (flicker == nullptr) return text + "; no level flickers.";
  const auto frames = std::count_if(rows.begin(), rows.end(),
                                    [](const PathRow& row) { return flickering(row) > 0; });
  return text + fmt::format(
                    "; levels flicker in {} frame{}, most in frame {}: {} pixels of {} "
                    "patch{}.",
                    frames, frames == 1 ? "" : "s", flicker->frame, *flicker->flicker_pixels,
                    *flicker->flicker_patches, *flicker->flicker_patches == 1 ? "" : "es");
}

std::string path_chart(const std::vector<PathRow>& rows, const std::string& title,
                       std::optional<double> tolerance_px, std::optional<double> limit_px) {
  const bool slices =
      std::any_of(rows.begin(), rows.end(), [](const PathRow& row) { return row.of_slices; });
  std::array<report::ScatterChart, 4> panels{
      panel("largest error, px"), panel("largest popping, px"), panel("flickering pixels"),
      panel(slices ? "fragments, millions" : "triangles, thousands")};
  panels.front().title = title;
  panels.back().x_label = "frame";
  mark(panels[0], tolerance_px, "tolerance");
  mark(panels[1], limit_px, "limit");
  for (const PathRow& row : rows) {
    add(panels[0], row, row.error_px);
    add(panels[1], row, row.popping_px);
    if (row.flicker_pixels) add(panels[2], row, static_cast<double>(*row.flicker_pixels));
    add(panels[3], row,
        slices ? 1e-6 * static_cast<double>(row.fragments)
               : 1e-3 * static_cast<double>(row.triangles));
  }
  return report::svg_of_panels(panels);
}

std::vector<std::string> write_path_report(const std::filesystem::path& folder,
                                           const std::vector<PathRow>& rows, const PathPage& page,
                                           const std::string& json) {
  make_folder(folder);
  const std::optional<double> tolerance = page.subject.tolerance.unit == Unit::Pixel
                                              ? std::optional(page.subject.tolerance.value)
                                              : std::nullopt;
  const std::string title = page_title(page.subject);
  const std::string chart = path_chart(
      rows,
      fmt::format("{} at {} along {}, {} frames", drawn_by(page.subject),
                  to_text(page.subject.tolerance), page.subject.camera_name, rows.size()),
      tolerance, page.limit_px);
  report::HtmlPage html(title);
  html.add_verdict(page.verdict == Verdict::Held     ? report::Verdict::Held
                   : page.verdict == Verdict::Broken ? report::Verdict::Broken
                                                     : report::Verdict::None,
                   page.sentence);
  html.add_paragraph(path_sentence(rows));
  html.add_chart("Along the path", chart);
  std::vector<const PathRow*> all;
  for (const PathRow& row : rows) all.push_back(&row);
  if (const auto worst = worst_frames(rows, popped); !worst.empty())
    html.add_links(frames_table("Frames that pop most", worst, page));
  html.add_links(frames_table("Frames that are farthest off",
                              worst_frames(rows, [](const PathRow& row) { return row.error_px; }),
                              page));
  html.add_links(frames_table("All frames", all, page));
  html.add_key_values("What was audited", subject_entries(page, rows.size()));
  write_file_atomically(folder / "path.svg", chart);
  write_file_atomically(folder / "audit.json", json);
  write_file_atomically(folder / "report.html", html.text());
  return {"report.html", "path.svg", "audit.json"};
}

}  // namespace plumb::audit::temporal
