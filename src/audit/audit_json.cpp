#include "audit/audit_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "audit/json_parts.h"

namespace plumb::audit {
namespace {

using Json = nlohmann::ordered_json;

Json triple_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

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
          {"eye_m", triple_json(c.eye_m)},
          {"right", triple_json(c.right)},
          {"up", triple_json(c.up)},
          {"forward", triple_json(c.forward)},
          {"size_px", {c.width_px, c.height_px}},
          {"gamma_px", {c.gamma_h, c.gamma_v}},
          {"centre_px", {c.centre_px.x, c.centre_px.y}},
          {"near_m", c.near_m},
          {"far_m", std::isfinite(c.far_m) ? Json(c.far_m) : Json(nullptr)}};
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
  json.update(Json::parse(measurements_json(result)));
  json["offenders"] = Json::parse(offenders_json(result));
  const AuditTimes& t = result.times;
  json["timing"] = {{"prepare_s", t.prepare_s},
                    {"draw_s", t.draw_s},
                    {"raster_s", t.raster_s},
                    {"truth_s", t.truth_s},
                    {"measure_s", t.measure_s}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace plumb::audit
