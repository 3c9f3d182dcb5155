#include "audit/sweep/line_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "audit/json_parts.h"
#include "audit/terrain_table.h"

namespace plumb::audit::sweep {
namespace {

using Json = nlohmann::ordered_json;

Json triple_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json terrain_json(const SweepPlan& plan, std::size_t index) {
  const SweepTerrain& terrain = plan.scene.terrains[index];
  Json options = Json::object();
  for (const auto& [name, value] : argument_texts(terrain.read)) options[name] = value;
  return {{"name", terrain.name},
          {"kind", terrain.kind},
          {"source", plan.terrains[index].source},
          {"options", options},
          {"checksum", plan.terrains[index].checksum}};
}

Json camera_json(const SweepPlan& plan, const PlacedView& view) {
  const SweepCamera& described = plan.scene.cameras[view.camera];
  const Camera& c = view.placed;
  return {{"name", described.name},
          {"frame", view.frame},
          {"path", described.is_path},
          {"eye_m", triple_json(c.eye_m)},
          {"right", triple_json(c.right)},
          {"up", triple_json(c.up)},
          {"forward", triple_json(c.forward)},
          {"gamma_px", {c.gamma_h, c.gamma_v}},
          {"centre_px", {c.centre_px.x, c.centre_px.y}},
          {"near_m", c.near_m},
          {"far_m", std::isfinite(c.far_m) ? Json(c.far_m) : Json(nullptr)}};
}

// What every line begins with.
Json head(const SweepPlan& plan, std::size_t index, const char* status) {
  const PlannedRun& run = plan.runs[index];
  return {{"schema", "plumb.sweep/1"},
          {"key", run.key},
          {"index", index},
          {"asked", Json::parse(run.asked)},
          {"status", status}};
}

}  // namespace

std::string asked_text(const SweepPlan& plan, const PlannedRun& run, const std::string& version) {
  const RunGroup& group = plan.groups[run.group];
  const PlacedTerrain& terrain = plan.terrains[group.terrain];
  const PlacedView& view = terrain.views[run.view];
  Json parameters = Json::object();
  for (const auto& [name, value] : group.choice.parameters) parameters[name] = value;
  const Json asked{
      {"terrain", terrain_json(plan, group.terrain)},
      {"method", group.method->name},
      {"variant", group.choice.variant},
      {"parameters", parameters},
      {"tolerance", {{"value", run.tolerance.value}, {"unit", name_of(run.tolerance.unit)}}},
      {"camera", camera_json(plan, view)},
      {"size_px", {view.placed.width_px, view.placed.height_px}},
      {"diagonal", terrain.field->stacks ? Json(nullptr) : Json(name_of(group.diagonal))},
      {"program", version}};
  return text_of(asked);
}

std::string done_line(const SweepPlan& plan, std::size_t run, const AuditResult& result,
                      const RunTiming& timing) {
  Json json = head(plan, run, "done");
  json["command"] = command_of(plan, plan.runs[run]);
  json["verdict"] = name_of(result.verdict());
  if (result.verdict() == Verdict::None) json["no_verdict"] = result.no_verdict;
  json.update(Json::parse(measurements_json(result)));
  const Json worst = Json::parse(offenders_json(result, 1));
  json["worst"] = worst.empty() ? Json(nullptr) : worst.front();
  json["timing"] = {
      {"prepare", {{"wall_s", timing.prepare_wall_s}, {"cpu_s", timing.prepare_cpu_s}}},
      {"draw",
       {{"runs", timing.draws},
        {"wall_s", timing.draw_wall_s},
        {"cpu_s", timing.draw_cpu_s},
        {"wall_spread_s", timing.draw_wall_spread_s},
        {"cpu_spread_s", timing.draw_cpu_spread_s}}},
      {"raster_s", result.times.raster_s},
      {"truth_s", result.times.truth_s},
      {"measure_s", result.times.measure_s},
      {"shared", timing.shared}};
  return text_of(json);
}

std::string failed_line(const SweepPlan& plan, std::size_t run, const std::string& error) {
  Json json = head(plan, run, "failed");
  json["error"] = error;
  json["command"] = command_of(plan, plan.runs[run]);
  return text_of(json);
}

std::string skipped_line(const SweepPlan& plan, std::size_t run) {
  Json json = head(plan, run, "skipped");
  json["error"] = plan.runs[run].skipped;
  json["command"] = command_of(plan, plan.runs[run]);
  return text_of(json);
}

}  // namespace plumb::audit::sweep
