#include "audit/audit_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace plumb::audit {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json triple(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json terrain_json(const AuditSubject& subject) {
  const terrain::Heightfield& field = *subject.field;
  const terrain::Provenance& from = field.provenance;
  return {{"source", from.source},
          {"checksum", fmt::format("{:016x}", terrain::checksum(field))},
          {"columns", field.columns()},
          {"rows", field.rows()},
          {"window", {from.window_x, from.window_y, field.columns(), field.rows()}},
          {"spacing_m", {field.dx_m, field.dy_m}},
          {"origin_m", {field.origin_m.x, field.origin_m.y}},
          {"voids", from.voids_declared + from.voids_not_finite},
          {"diagonal", subject.field->stacks ? Json(nullptr) : Json(name_of(subject.truth))},
          {"assumptions", from.assumptions}};
}

Json camera_json(const AuditSubject& subject) {
  const Camera& c = subject.camera;
  return {{"name", subject.camera_name},
          {"eye_m", triple(c.eye_m)},
          {"right", triple(c.right)},
          {"up", triple(c.up)},
          {"forward", triple(c.forward)},
          {"size_px", {c.width_px, c.height_px}},
          {"gamma_px", {c.gamma_h, c.gamma_v}},
          {"centre_px", {c.centre_px.x, c.centre_px.y}},
          {"near_m", c.near_m},
          {"far_m", number(c.far_m)}};
}

Json distribution_json(const Distribution& d) {
  return {{"count", d.count},           {"infinite", d.infinite}, {"max", number(d.max)},
          {"max_finite", d.max_finite}, {"rms", d.rms},           {"p50", number(d.p50)},
          {"p95", number(d.p95)},       {"p99", number(d.p99)},   {"p99.9", number(d.p999)}};
}

Json offender_json(const Offender& o) {
  Json json{{"what", o.what}, {"value", number(o.value)}, {"unit", name_of(o.unit)}};
  json["pixel"] = o.x >= 0 ? Json::array({o.x, o.y}) : Json(nullptr);
  json["sample"] = o.sample_i >= 0 ? Json::array({o.sample_i, o.sample_j}) : Json(nullptr);
  json["world_m"] = triple(o.world_m);
  json["patch"] = o.patch >= 0 ? Json(o.patch) : Json(nullptr);
  if (!o.patch_name.empty()) json["patch_name"] = o.patch_name;
  json["triangle"] = o.triangle != kNoPrimitive ? Json(o.triangle) : Json(nullptr);
  json["breaks"] = o.breaks.empty() ? Json(nullptr) : Json(o.breaks);
  return json;
}

Json claim_json(const ClaimResult& c) {
  Json json{{"measure", c.label},
            {"by", c.is_limit ? "user" : "method"},
            {"scope", name_of(c.claim.scope)},
            {"claimed", number(c.claim.bound)},
            {"unit", name_of(c.claim.unit)},
            {"measured", c.is_measured ? number(c.measured) : Json(nullptr)},
            {"rounding", c.slack},
            {"violations", c.violations},
            {"holds", c.is_measured ? Json(c.holds) : Json(nullptr)},
            {"verdict", c.is_measured ? name_of(c.verdict()) : "not measured"}};
  const auto tightness = c.tightness();
  json["tightness"] = tightness ? number(*tightness) : Json(nullptr);
  if (c.triangles_over >= 0) json["triangles_over"] = c.triangles_over;
  if (c.claim.scope == Scope::Patch) json["patch"] = c.claim.patch;
  if (c.claim.unreachable) json["unreachable"] = true;
  if (c.worst) json["worst"] = offender_json(*c.worst);
  return json;
}

Json coverage_json(const Coverage& c) {
  return {{"band_px", c.band_px},
          {"must_be_terrain", c.must_be_terrain},
          {"must_be_sky", c.must_be_sky},
          {"either", c.either},
          {"holes", c.holes},
          {"overshoots", c.overshoots},
          {"see_through", c.see_through}};
}

Json topology_json(const Topology& t) {
  return {{"triangles", t.triangles},
          {"vertices", t.vertices},
          {"boundary_edges", t.boundary_edges},
          {"open_edges", t.open_edges},
          {"t_junctions", t.t_junctions},
          {"non_manifold_edges", t.non_manifold_edges},
          {"non_manifold_vertices", t.non_manifold_vertices},
          {"degenerate_triangles", t.degenerate_triangles},
          {"folded_triangles", t.folded_triangles},
          {"overlapped_samples", t.overlapped_samples},
          {"largest_lod_jump", t.largest_lod_jump}};
}

// What only a truth that is no heightfield has.
Json solid_errors_json(const NearestErrors& n) {
  return {{"pixel_nearest_m", distribution_json(n.forward_metres)},
          {"pixel_nearest_reverse_m", distribution_json(n.reverse_metres)},
          {"vertex_m", distribution_json(n.forward_vertices.distribution)},
          {"vertex_reverse_m", distribution_json(n.reverse_vertices.distribution)}};
}

Json cost_json(const Cost& c) {
  return {{"vertices", c.vertices},
          {"triangles", c.triangles},
          {"slices", c.slices},
          {"fragments", c.fragments},
          {"nodes_visited", c.nodes_visited},
          {"bytes_resident", c.bytes_resident},
          {"bytes_encoded", c.bytes_encoded}};
}

Json registration_json(const Registration& r) {
  return {{"agrees", r.agrees},
          {"mean_shift_px", {r.mean_shift_px.x, r.mean_shift_px.y}},
          {"largest_shift_px", number(r.largest_shift_px)},
          {"eye_offset_m", triple(r.eye_offset_m)},
          {"largest_off_plane_m", number(r.largest_off_plane_m)}};
}

}  // namespace

std::string audit_json(const AuditResult& result, const AuditSubject& subject) {
  Json json{{"schema", "plumb.audit/1"},
            {"command", subject.command},
            {"verdict", name_of(result.verdict())}};
  if (result.verdict() == Verdict::None) json["no_verdict"] = result.no_verdict;
  json["terrain"] = terrain_json(subject);
  json["method"] = {{"name", subject.method},
                    {"variant", subject.variant},
                    {"parameters", subject.parameters},
                    {"tolerance", to_text(subject.tolerance)},
                    {"assumptions", subject.assumptions},
                    {"hints", subject.hints},
                    {"notes", subject.notes}};
  json["camera"] = camera_json(subject);
  json["claims"] = Json::array();
  for (const ClaimResult& claim : result.claims) json["claims"].push_back(claim_json(claim));
  json["patch_claims"] = {{"judged", result.patch_claims}, {"broken", result.patch_claims_broken}};
  // null: only a mesh has it.
  const auto of_mesh = [&](Json value) {
    return result.of_mesh ? std::move(value) : Json(nullptr);
  };
  // null: only of heightfields it is measured.
  const auto of_heights = [&](Json value) {
    return result.of_mesh && result.of_heights ? std::move(value) : Json(nullptr);
  };
  json["errors"] = {
      {"sample_m", of_heights(distribution_json(result.samples.metres))},
      {"sample_px", of_heights(distribution_json(result.samples.pixels))},
      {"sample_visible_px", of_heights(distribution_json(result.samples.visible_pixels))},
      {"between_samples", of_heights({{"places", result.edges.places},
                                      {"max_m", result.edges.max_m},
                                      {"max_px", number(result.edges.max_px)}})},
      {"pixel_vertical_px", result.of_heights ? distribution_json(result.vertical) : Json(nullptr)},
      {"pixel_vertical_reverse_px", of_heights(distribution_json(result.reverse_vertical))},
      {"pixel_nearest_px", distribution_json(result.nearest.forward)},
      {"pixel_nearest_reverse_px", of_mesh(distribution_json(result.nearest.reverse))},
      {"depth_relative", distribution_json(result.depth)},
      {"normal_deg", of_mesh(distribution_json(result.normal_deg))}};
  if (!result.of_heights) json["errors"].update(solid_errors_json(result.nearest));
  json["samples"] = of_heights(
      {{"uncovered", result.samples.uncovered}, {"drawn_over_void", result.samples.over_void}});
  json["coverage"] = coverage_json(result.coverage);
  if (!result.of_mesh) json["coverage"]["set_aside"] = result.pixels_set_aside;
  json["topology"] = of_mesh(topology_json(result.topology));
  if (result.topology.self_intersections >= 0)
    json["topology"]["self_intersections"] = result.topology.self_intersections;
  if (!result.of_heights) json["topology"]["overlapped_samples"] = nullptr;
  json["registration"] = registration_json(result.registration);
  json["cost"] = cost_json(result.cost);
  json["offenders"] = Json::array();
  for (const Offender& offender : result.offenders)
    json["offenders"].push_back(offender_json(offender));
  const AuditTimes& t = result.times;
  json["timing"] = {{"prepare_s", t.prepare_s},
                    {"draw_s", t.draw_s},
                    {"raster_s", t.raster_s},
                    {"truth_s", t.truth_s},
                    {"measure_s", t.measure_s}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace plumb::audit
