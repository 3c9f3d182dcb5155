#include "audit/json_parts.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace plumb::audit {
namespace {

using Json = nlohmann::ordered_json;

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json triple_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json offender_json(const Offender& o) {
  Json json{{"what", o.what}, {"value", number_json(o.value)}, {"unit", name_of(o.unit)}};
  json["pixel"] = o.x >= 0 ? Json::array({o.x, o.y}) : Json(nullptr);
  json["sample"] = o.sample_i >= 0 ? Json::array({o.sample_i, o.sample_j}) : Json(nullptr);
  json["world_m"] = triple_json(o.world_m);
  json["patch"] = o.patch >= 0 ? Json(o.patch) : Json(nullptr);
  if (!o.patch_name.empty()) json["patch_name"] = o.patch_name;
  json["triangle"] = o.triangle != kNoPrimitive ? Json(o.triangle) : Json(nullptr);
  json["breaks"] = o.breaks.empty() ? Json(nullptr) : Json(o.breaks);
  return json;
}

Json distribution_json(const Distribution& d) {
  return {{"count", d.count},
          {"infinite", d.infinite},
          {"max", number_json(d.max)},
          {"max_finite", d.max_finite},
          {"rms", d.rms},
          {"p50", number_json(d.p50)},
          {"p95", number_json(d.p95)},
          {"p99", number_json(d.p99)},
          {"p99.9", number_json(d.p999)}};
}

Json claim_json(const ClaimResult& c) {
  Json json{{"measure", c.label},
            {"by", c.is_limit ? "user" : "method"},
            {"scope", name_of(c.claim.scope)},
            {"claimed", number_json(c.claim.bound)},
            {"unit", name_of(c.claim.unit)},
            {"measured", c.is_measured ? number_json(c.measured) : Json(nullptr)},
            {"rounding", c.slack},
            {"violations", c.violations},
            {"holds", c.is_measured ? Json(c.holds) : Json(nullptr)},
            {"verdict", c.is_measured ? name_of(c.verdict()) : "not measured"}};
  const auto tightness = c.tightness();
  json["tightness"] = tightness ? number_json(*tightness) : Json(nullptr);
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
          {"largest_shift_px", number_json(r.largest_shift_px)},
          {"eye_offset_m", triple_json(r.eye_offset_m)},
          {"largest_off_plane_m", number_json(r.largest_off_plane_m)}};
}

Json claims_json(const AuditResult& result) {
  Json claims = Json::array();
  for (const ClaimResult& claim : result.claims) claims.push_back(claim_json(claim));
  return claims;
}

// What only a mesh has, and what only a mesh over a heightfield: null elsewhere.
Json of_mesh(const AuditResult& result, Json value) {
  return result.of_mesh ? std::move(value) : Json(nullptr);
}
Json of_heights(const AuditResult& result, Json value) {
  return result.of_mesh && result.of_heights ? std::move(value) : Json(nullptr);
}

Json errors_json(const AuditResult& result) {
  Json json{
      {"sample_m", of_heights(result, distribution_json(result.samples.metres))},
      {"sample_px", of_heights(result, distribution_json(result.samples.pixels))},
      {"sample_visible_px", of_heights(result, distribution_json(result.samples.visible_pixels))},
      {"between_samples", of_heights(result, {{"places", result.edges.places},
                                              {"max_m", result.edges.max_m},
                                              {"max_px", number_json(result.edges.max_px)}})},
      {"pixel_vertical_px", result.of_heights ? distribution_json(result.vertical) : Json(nullptr)},
      {"pixel_vertical_reverse_px", of_heights(result, distribution_json(result.reverse_vertical))},
      {"pixel_nearest_px", distribution_json(result.nearest.forward)},
      {"pixel_nearest_reverse_px", of_mesh(result, distribution_json(result.nearest.reverse))},
      {"depth_relative", distribution_json(result.depth)},
      {"normal_deg", of_mesh(result, distribution_json(result.normal_deg))}};
  if (!result.of_heights) json.update(solid_errors_json(result.nearest));
  return json;
}

Json all_coverage_json(const AuditResult& result) {
  Json json = coverage_json(result.coverage);
  if (!result.of_mesh) json["set_aside"] = result.pixels_set_aside;
  return json;
}

Json all_topology_json(const AuditResult& result) {
  Json json = of_mesh(result, topology_json(result.topology));
  if (result.topology.self_intersections >= 0)
    json["self_intersections"] = result.topology.self_intersections;
  if (!result.of_heights) json["overlapped_samples"] = nullptr;
  return json;
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string measurements_json(const AuditResult& result) {
  Json to;
  to["claims"] = claims_json(result);
  to["patch_claims"] = {{"judged", result.patch_claims}, {"broken", result.patch_claims_broken}};
  to["errors"] = errors_json(result);
  to["samples"] = of_heights(result, {{"uncovered", result.samples.uncovered},
                                      {"drawn_over_void", result.samples.over_void}});
  to["coverage"] = all_coverage_json(result);
  to["topology"] = all_topology_json(result);
  to["registration"] = registration_json(result.registration);
  to["cost"] = cost_json(result.cost);
  return text_of(to);
}

std::string offenders_json(const AuditResult& result, std::size_t most) {
  Json list = Json::array();
  for (std::size_t k = 0; k < std::min(most, result.offenders.size()); ++k)
    list.push_back(offender_json(result.offenders[k]));
  return text_of(list);
}

}  // namespace plumb::audit
