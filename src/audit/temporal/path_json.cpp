#include "audit/temporal/path_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "audit/audit_json.h"

namespace plumb::audit::temporal {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json triple(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

Json there_json(const DrawnThere& there, bool of_mesh) {
  Json json;
  json["level"] = there.level >= 0 ? Json(there.level) : Json(nullptr);
  json["patch"] = there.patch >= 0 ? Json(there.patch) : Json(nullptr);
  if (!there.patch_name.empty()) json["patch_name"] = there.patch_name;
  json["triangle"] =
      of_mesh && there.primitive != kNoPrimitive ? Json(there.primitive) : Json(nullptr);
  return json;
}

Json popping_json(const Popping& popping, bool of_mesh) {
  const Distribution& d = popping.pixels;
  Json json{{"pixels", d.count},
            {"infinite", d.infinite},
            {"max_px", number(popping.max_px)},
            {"rms_px", d.rms},
            {"p50_px", number(d.p50)},
            {"p95_px", number(d.p95)},
            {"p99_px", number(d.p99)},
            {"p99.9_px", number(d.p999)},
            {"pixels_over_1px", popping.over_1px}};
  json["worst"] = nullptr;
  if (popping.worst) {
    const PoppedPlace& worst = *popping.worst;
    json["worst"] = {{"pixel", {worst.x, worst.y}},
                     {"world_m", triple(worst.world_m)},
                     {"px", number(worst.px)},
                     {"m", number(worst.m)},
                     {"before", there_json(worst.before, of_mesh)},
                     {"after", there_json(worst.after, of_mesh)}};
  }
  json["vertices"] = nullptr;
  if (popping.vertices)
    json["vertices"] = {{"count", popping.vertices->count},
                        {"max_px", number(popping.vertices->max_px)},
                        {"max_m", popping.vertices->max_m},
                        {"world_m", triple(popping.vertices->worst_m)}};
  return json;
}

Json flicker_json(const Flicker& flicker) {
  Json json{
      {"compared", flicker.compared}, {"pixels", flicker.pixels}, {"patches", flicker.patches}};
  json["worst"] = nullptr;
  if (flicker.worst.patch >= 0)
    json["worst"] = {{"patch", flicker.worst.patch},
                     {"patch_name", flicker.worst.patch_name},
                     {"level", flicker.worst.level},
                     {"pixels", flicker.worst_pixels}};
  return json;
}

}  // namespace

std::string frame_json(const AuditResult& audited, const AuditSubject& subject,
                       const FrameChange& change) {
  Json json = Json::parse(audit_json(audited, subject));
  json["popping"] = change.popping ? popping_json(*change.popping, audited.of_mesh) : Json(nullptr);
  json["flicker"] = change.flicker ? flicker_json(*change.flicker) : Json(nullptr);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string path_json(const std::vector<std::string>& frames) {
  std::string list;
  for (const std::string& frame : frames) list += (list.empty() ? "" : ",\n") + frame;
  return "{\"schema\": \"plumb.audit-path/1\", \"frames\": [\n" + list + "]}\n";
}

std::string popping_summary_json(const FrameChange& change) {
  if (!change.popping) return "null";
  const Popping& popping = *change.popping;
  Json json{{"max_px", number(popping.max_px)},
            {"p99_px", number(popping.pixels.p99)},
            {"pixels_over_1px", popping.over_1px}};
  json["flicker_pixels"] = change.flicker ? Json(change.flicker->pixels) : Json(nullptr);
  return json.dump();
}

}  // namespace plumb::audit::temporal
