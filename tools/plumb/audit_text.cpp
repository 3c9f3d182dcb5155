#include "audit_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "audit/verdict_text.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

using audit::AuditResult;
using Rows = std::vector<std::vector<std::string>>;

Rows claim_rows(const AuditResult& result) {
  Rows rows;
  for (const audit::ClaimResult& c : result.claims) {
    const auto tightness = c.tightness();
    rows.push_back({c.label,
                    c.claim.scope == Scope::Frame ? (c.is_limit ? "limit" : "frame")
                                                  : fmt::format("patch {}", c.claim.patch),
                    audit::with_unit(c.claim.bound, c.claim.unit),
                    c.is_measured ? audit::with_unit(c.measured, c.claim.unit) : "-",
                    tightness ? audit::short_number(*tightness) : "-",
                    c.is_measured ? std::to_string(c.violations) : "-", audit::verdict_word(c)});
  }
  return rows;
}

Rows error_rows(const AuditResult& result) {
  Rows rows;
  const auto add = [&](const char* name, const audit::Distribution& d) {
    rows.push_back({name, audit::short_number(d.max), audit::short_number(d.p99),
                    audit::short_number(d.rms), std::to_string(d.count)});
  };
  const auto add_of_mesh = [&](const char* name, const audit::Distribution& d) {
    if (result.of_mesh) add(name, d);
  };
  if (result.of_heights) {
    add_of_mesh("sample error, m", result.samples.metres);
    add_of_mesh("sample error in view, px", result.samples.pixels);
    add("pixel error, vertical, px", result.vertical);
    add_of_mesh("  from the truth, px", result.reverse_vertical);
  }
  if (!result.nearest.forward_px.empty()) {
    add("pixel error, nearest, px", result.nearest.forward);
    add_of_mesh("  from the truth, px", result.nearest.reverse);
  }
  if (!result.nearest.forward_m.empty()) {
    add("pixel error, nearest, m", result.nearest.forward_metres);
    add("  from the truth, m", result.nearest.reverse_metres);
    add("vertices, in view or not, m", result.nearest.forward_vertices.distribution);
    add("  from the truth, m", result.nearest.reverse_vertices.distribution);
  }
  add("depth, relative", result.depth);
  add_of_mesh("normals, degrees", result.normal_deg);
  return rows;
}

Rows summary_rows(const AuditResult& result) {
  const audit::Coverage& c = result.coverage;
  const audit::Topology& t = result.topology;
  const audit::AuditTimes& s = result.times;
  Rows rows{{"coverage", fmt::format("{} holes, {} overshoots, {} see-through pixels", c.holes,
                                     c.overshoots, c.see_through)}};
  if (result.of_mesh) {
    if (result.of_heights)
      rows.push_back({"samples", fmt::format("{} with nothing drawn over them, {} voids drawn over",
                                             result.samples.uncovered, result.samples.over_void)});
    rows.push_back(
        {"topology",
         fmt::format("{} open edges, {} T-junctions, {} non-manifold, {} degenerate, {} folded",
                     t.open_edges, t.t_junctions, t.non_manifold_edges + t.non_manifold_vertices,
                     t.degenerate_triangles, t.folded_triangles)});
    if (t.self_intersections >= 0)
      rows.push_back({"itself", fmt::format("{} pairs of triangles pass through each other",
                                            t.self_intersections)});
  } else if (result.of_solid) {
    rows.push_back(
        {"set aside", fmt::format("{} pixels whose rays get below the ground without crossing it",
                                  result.pixels_set_aside)});
  } else {
    rows.push_back({"not told", "samples, topology and normals: a depth buffer has no triangles"});
  }
  if (result.of_mesh || result.of_solid)
    rows.push_back(
        {"drawn", result.cost.slices > 0
                      ? fmt::format("{} slices, {} triangles, {} fragments", result.cost.slices,
                                    result.cost.triangles, result.cost.fragments)
                      : fmt::format("{} triangles, {} fragments", result.cost.triangles,
                                    result.cost.fragments)});
  rows.push_back({"patches", fmt::format("{} claims of their own judged, {} broken",
                                         result.patch_claims, result.patch_claims_broken)});
  rows.push_back(
      {"time",
       fmt::format("prepare {:.3f} s, draw {:.3f}, raster {:.3f}, truth {:.3f}, measures {:.3f}",
                   s.prepare_s, s.draw_s, s.raster_s, s.truth_s, s.measure_s)});
  return rows;
}

}  // namespace

std::string audit_text(const AuditResult& result) {
  std::string text = text_table({{"claim"},
                                 {"scope"},
                                 {"claimed", true},
                                 {"measured", true},
                                 {"tightness", true},
                                 {"violations", true},
                                 {"verdict"}},
                                claim_rows(result));
  text += "\n" +
          text_table({{"error"}, {"max", true}, {"p99", true}, {"RMS", true}, {"of", true}},
                     error_rows(result)) +
          "\n";
  text += text_table({{""}, {""}}, summary_rows(result));
  for (const std::string& line : audit::worst_lines(result)) text += line + "\n";
  return text + "\n" + audit::verdict_sentence(result) + "\n";
}

namespace {

// The frame claim that is nearest to its bound, or farthest beyond it.
const audit::ClaimResult* tightest(const AuditResult& result) {
  const audit::ClaimResult* least = nullptr;
  for (const audit::ClaimResult& claim : result.claims) {
    if (claim.claim.scope != Scope::Frame || !claim.tightness()) continue;
    if (least == nullptr || *claim.tightness() < *least->tightness()) least = &claim;
  }
  return least;
}

const char* frame_verdict(audit::Verdict verdict) {
  return verdict == audit::Verdict::Held     ? "held"
         : verdict == audit::Verdict::Broken ? "BROKEN"
                                             : "no verdict";
}

// The largest of the picture; "-" where none was measured.
std::string pixel_error_text(const AuditResult& result) {
  const audit::Distribution &up = result.vertical, &forth = result.nearest.forward,
                            &back = result.nearest.reverse;
  if ((result.of_heights ? up.count : forth.count + back.count) == 0) return "-";
  return audit::short_number(result.of_heights ? up.max : std::max(forth.max, back.max));
}

}  // namespace

std::vector<std::string> frame_row(std::size_t number, const AuditResult& result) {
  const audit::ClaimResult* claim = tightest(result);
  return {std::to_string(number),
          frame_verdict(result.verdict()),
          claim ? claim->label : "-",
          claim ? audit::with_unit(claim->claim.bound, claim->claim.unit) : "-",
          claim ? audit::with_unit(claim->measured, claim->claim.unit) : "-",
          pixel_error_text(result),
          std::to_string(result.coverage.holes + result.coverage.see_through),
          std::to_string(result.cost.triangles),
          fmt::format("{:.2f}", result.times.truth_s + result.times.measure_s)};
}

const std::vector<TextColumn>& frame_columns() {
  static const std::vector<TextColumn> columns{
      {"frame", true},   {"verdict"},         {"tightest claim"},
      {"claimed", true}, {"measured", true},  {"pixel error, px", true},
      {"holes", true},   {"triangles", true}, {"s", true}};
  return columns;
}

}  // namespace plumb::tool
