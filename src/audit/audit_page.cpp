#include "audit/audit_page.h"

#include <fmt/format.h>

#include <system_error>

#include "audit/audit_gallery.h"
#include "audit/audit_json.h"
#include "audit/verdict_text.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "report/html_page.h"

namespace plumb::audit {
namespace {

namespace fs = std::filesystem;

report::RowKind kind_of(const ClaimResult& claim) {
  return claim.holds         ? report::RowKind::Ok
         : claim.is_measured ? report::RowKind::Bad
                             : report::RowKind::Plain;
}

report::Verdict banner_of(Verdict verdict) {
  return verdict == Verdict::Held     ? report::Verdict::Held
         : verdict == Verdict::Broken ? report::Verdict::Broken
                                      : report::Verdict::None;
}

report::Table claims_table(const AuditResult& result) {
  report::Table table{"Claims and limits",
                      {{"measure"},
                       {"scope"},
                       {"by"},
                       {"claimed", true},
                       {"measured", true},
                       {"tightness", true},
                       {"violations", true},
                       {"triangles over", true},
                       {"verdict"}},
                      {}};
  for (const ClaimResult& c : result.claims) {
    const auto tightness = c.tightness();
    const std::string scope =
        c.claim.scope == Scope::Frame ? "frame" : fmt::format("patch {}", c.claim.patch);
    table.rows.push_back(
        {{c.label, scope, c.is_limit ? "user" : "method", with_unit(c.claim.bound, c.claim.unit),
          c.is_measured ? with_unit(c.measured, c.claim.unit) : "-",
          tightness ? short_number(*tightness) : "-",
          c.is_measured ? std::to_string(c.violations) : "-",
          c.is_measured && c.triangles_over >= 0 ? std::to_string(c.triangles_over) : "-",
          verdict_word(c)},
         kind_of(c)});
  }
  return table;
}

report::Table errors_table(const AuditResult& result) {
  report::Table table{"Errors measured",
                      {{"measure"},
                       {"of", true},
                       {"max", true},
                       {"RMS", true},
                       {"50 %", true},
                       {"95 %", true},
                       {"99 %", true},
                       {"99.9 %", true},
                       {"without counterpart", true}},
                      {}};
  const auto add = [&](const char* name, const Distribution& d) {
    table.rows.push_back({{name, std::to_string(d.count), short_number(d.max_finite),
                           short_number(d.rms), short_number(d.p50), short_number(d.p95),
                           short_number(d.p99), short_number(d.p999), std::to_string(d.infinite)},
                          report::RowKind::Plain});
  };
  const auto add_of_mesh = [&](const char* name, const Distribution& d) {
    if (result.of_mesh) add(name, d);
  };
  if (result.of_heights) {
    add_of_mesh("samples, metres", result.samples.metres);
    add_of_mesh("samples in view, pixels", result.samples.pixels);
    add_of_mesh("samples visible, pixels", result.samples.visible_pixels);
    add("pixels, vertical, pixels", result.vertical);
    add_of_mesh("the same from the truth", result.reverse_vertical);
  }
  if (!result.nearest.forward_px.empty()) {
    add("pixels, nearest point, pixels", result.nearest.forward);
    add_of_mesh("the same from the truth", result.nearest.reverse);
  }
  if (!result.nearest.forward_m.empty()) {
    add("pixels, nearest point, metres", result.nearest.forward_metres);
    add("the same from the truth", result.nearest.reverse_metres);
    add("vertices, in view or not, nearest point, metres",
        result.nearest.forward_vertices.distribution);
    add("the same from the truth", result.nearest.reverse_vertices.distribution);
  }
  add("depth, relative", result.depth);
  add_of_mesh("normals, degrees", result.normal_deg);
  return table;
}

std::vector<report::KeyValue> shape_entries(const AuditResult& result) {
  const Coverage& c = result.coverage;
  const SampleErrors& s = result.samples;
  const Topology& t = result.topology;
  std::vector<report::KeyValue> entries{
      {"pixels that must be terrain, must be sky, may be either",
       fmt::format("{}, {}, {} (band of {} px along silhouettes)", c.must_be_terrain, c.must_be_sky,
                   c.either, c.band_px)},
      {"holes, overshoots, see-through pixels",
       fmt::format("{}, {}, {}", c.holes, c.overshoots, c.see_through)}};
  if (!result.of_mesh && !result.of_solid) {
    entries.push_back(
        {"not told", "samples, topology and normals: a depth buffer has no triangles"});
    return entries;
  }
  if (!result.of_mesh) {
    entries.push_back({"pixels set aside: their rays get below the ground without crossing it",
                       std::to_string(result.pixels_set_aside)});
    return entries;
  }
  if (result.of_heights) {
    entries.push_back({"samples with nothing drawn over them", std::to_string(s.uncovered)});
    entries.push_back({"void samples drawn over", std::to_string(s.over_void)});
    entries.push_back({"samples under more than one triangle", std::to_string(s.overlapped)});
  } else {
    entries.push_back({"not told", "samples and vertical distances: the truth is no heightfield"});
    entries.push_back(
        {"pairs of triangles that pass through each other", std::to_string(t.self_intersections)});
  }
  const std::vector<report::KeyValue> of_mesh{
      {"open edges, T-junctions", fmt::format("{}, {}", t.open_edges, t.t_junctions)},
      {"non-manifold edges, vertices",
       fmt::format("{}, {}", t.non_manifold_edges, t.non_manifold_vertices)},
      {"degenerate, folded triangles",
       fmt::format("{}, {}", t.degenerate_triangles, t.folded_triangles)},
      {"largest jump of levels between neighbours", std::to_string(t.largest_lod_jump)}};
  entries.insert(entries.end(), of_mesh.begin(), of_mesh.end());
  return entries;
}

std::string registration_text(const Registration& r) {
  if (r.agrees)
    return "agrees: every point drawn is seen at its own pixel and lies on what the picture names";
  return fmt::format(
      "does NOT agree: points are seen {} px (mean {:+.3g}, {:+.3g}) off their pixels and up to {} "
      "m off their "
      "triangles; an eye moved by ({:.4g}, {:.4g}, {:.4g}) m explains that best",
      short_number(r.largest_shift_px), r.mean_shift_px.x, r.mean_shift_px.y,
      short_number(r.largest_off_plane_m), r.eye_offset_m.x, r.eye_offset_m.y, r.eye_offset_m.z);
}

std::vector<report::KeyValue> subject_entries(const AuditResult& result,
                                              const AuditSubject& subject) {
  const terrain::Heightfield& field = *subject.field;
  const Camera& c = subject.camera;
  std::vector<report::KeyValue> entries{
      {"terrain",
       fmt::format("{} ({} x {} samples, {:.6g} x {:.6g} m apart)", field.provenance.source,
                   field.columns(), field.rows(), field.dx_m, field.dy_m)},
      {"truth", result.of_heights
                    ? fmt::format("full-detail triangles, diagonals {}", name_of(subject.truth))
                    : "the stacks' finest level as a mesh"},
      {"method", subject.variant.empty() ? subject.method
                                         : fmt::format("{}, {}", subject.method, subject.variant)},
      {"tolerance", to_text(subject.tolerance)},
      {"camera",
       fmt::format(
           "{}: eye ({:.8g}, {:.8g}, {:.8g}) m, looking along ({:.4g}, {:.4g}, {:.4g}), {} x {} px",
           subject.camera_name, c.eye_m.x, c.eye_m.y, c.eye_m.z, c.forward.x, c.forward.y,
           c.forward.z, c.width_px, c.height_px)},
      {"picture and camera", registration_text(result.registration)},
      {"drawn", drawn_text(result.cost)},
      {"patches' own claims",
       fmt::format("{} judged, {} broken", result.patch_claims, result.patch_claims_broken)},
      {"made again by", subject.command}};
  for (const std::string& assumption : field.provenance.assumptions)
    entries.push_back({"assumed", assumption});
  for (const std::string& assumption : subject.assumptions)
    entries.push_back({"assumed", assumption});
  return entries;
}

report::OffenderList offender_list(const AuditResult& result, const AuditSubject& subject) {
  report::OffenderList list{"Worst offenders",
                            "pictures",
                            {{"what"},
                             {"value", true},
                             {"breaks"},
                             {"sample"},
                             {"world, m"},
                             {"triangle", true},
                             {"patch"}},
                            {}};
  for (const Offender& o : result.offenders) {
    const std::string sample =
        o.sample_i >= 0
            ? fmt::format(
                  "column {}, row {}", subject.field->provenance.window_x + o.sample_i,
                  subject.field->provenance.window_y + subject.field->rows() - 1 - o.sample_j)
            : "-";
    list.offenders.push_back(
        {o.x,
         o.y,
         {o.what, o.unit == Unit::Count ? "-" : with_unit(o.value, o.unit),
          o.breaks.empty() ? "-" : o.breaks, sample,
          fmt::format("{:.9g}, {:.9g}, {:.7g}", o.world_m.x, o.world_m.y, o.world_m.z),
          o.triangle != kNoPrimitive ? std::to_string(o.triangle) : "-",
          o.patch >= 0 ? fmt::format("{}: {}", o.patch, o.patch_name) : "-"}});
  }
  return list;
}

report::HtmlPage page_of(const AuditResult& result, const AuditSubject& subject,
                         const DrawnSurface& surface, const report::Viewer& viewer,
                         const std::string& json) {
  report::HtmlPage page(fmt::format("{} at {} on {}", subject.method, to_text(subject.tolerance),
                                    subject.field->provenance.source));
  page.add_verdict(banner_of(result.verdict()), verdict_sentence(result));
  for (const std::string& hint : subject.hints) page.add_paragraph(hint);
  page.add_table(claims_table(result));
  page.add_viewer(viewer);
  page.add_offenders(offender_list(result, subject));
  page.add_table(errors_table(result));
  page.add_key_values("Coverage and topology", shape_entries(result));
  page.add_key_values("What was audited", subject_entries(result, subject));
  for (const std::string& note : surface.notes) page.add_paragraph(note);
  page.add_details("JSON of this run", json);
  return page;
}

}  // namespace

std::string drawn_text(const Cost& cost) {
  std::string text = fmt::format("{} triangles", cost.triangles);
  if (cost.slices > 0) text += fmt::format(", {} slices", cost.slices);
  return text + fmt::format(", {} vertices, {} fragments", cost.vertices, cost.fragments);
}

std::vector<std::string> write_report(const fs::path& folder, const AuditResult& result,
                                      const AuditSubject& subject, const DrawnSurface& surface,
                                      const TruthTerms& truth) {
  make_folder(folder);
  const std::vector<Shown> pictures = gallery(result, subject, surface, truth);
  const report::Viewer viewer = write_gallery(folder, pictures, result);
  const std::string json = audit_json(result, subject);
  write_file_atomically(folder / "audit.json", json);
  write_file_atomically(folder / "report.html",
                        page_of(result, subject, surface, viewer, json).text());
  std::vector<std::string> files{"report.html", "audit.json"};
  for (const Shown& shown : pictures) files.push_back(shown.file);
  return files;
}

}  // namespace plumb::audit
