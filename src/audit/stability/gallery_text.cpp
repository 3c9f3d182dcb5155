#include "audit/stability/gallery_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "audit/verdict_text.h"

namespace plumb::audit::stability {
namespace {

using Json = nlohmann::ordered_json;

std::string number(const Scene& scene, const Expected& expected, double value) {
  const Unit unit = unit_of(expected.reading, scene.tolerance.unit);
  const bool is_whole = unit == Unit::Count && std::isfinite(value) && value == std::floor(value);
  return is_whole ? fmt::format("{:.0f}", value) : with_unit(value, unit);
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json expected_json(const Scene& scene, const Expected& expected) {
  if (!expected.refusal.empty()) return {{"refused", expected.refusal}};
  Json json{{"verdict", expected.verdict ? Json(name_of(*expected.verdict)) : Json(nullptr)},
            {"reading", name_of(expected.reading)},
            {"unit", name_of(unit_of(expected.reading, scene.tolerance.unit))},
            {"least", expected.least},
            {"most", number_or_null(expected.most)}};
  return json;
}

Json variant_json(const SceneRun& run, const VariantRun& variant, const Expected& expected) {
  Json json{{"expected", expected_json(*run.scene, expected)}};
  if (!variant.refused.empty()) {
    json["refused"] = variant.refused;
  } else {
    json["verdict"] = name_of(variant.verdict);
    json["sentence"] = variant.sentence;
    json["claimed"] = variant.claimed ? number_or_null(*variant.claimed) : Json(nullptr);
    json["measured"] = number_or_null(variant.measured);
    if (!variant.broken_by.empty()) json["broken_by"] = variant.broken_by;
    json["patch_claims_broken"] = variant.patch_claims_broken;
    json["counters"] = {{"triangles", variant.cost.triangles},
                        {"slices", variant.cost.slices},
                        {"fragments", variant.cost.fragments}};
  }
  json["as_expected"] = variant.is_as_expected;
  return json;
}

Json point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

Json camera_json(const LookAt& camera) {
  return {{"eye", point(camera.eye_m)}, {"target", point(camera.target_m)},
          {"up", point(camera.up)},     {"fov_y_deg", camera.fov_y_deg},
          {"width", camera.width_px},   {"height", camera.height_px},
          {"near", camera.near_m}};
}

}  // namespace

std::string number_text(const SceneRun& run, const Expected& expected, double value) {
  return number(*run.scene, expected, value);
}

std::string summary_text(const std::vector<SceneRun>& runs) {
  const auto expected = std::count_if(runs.begin(), runs.end(),
                                      [](const SceneRun& run) { return run.is_as_expected(); });
  return fmt::format("{} of {} scenes are as expected.", expected, runs.size());
}

std::string measured_text(const SceneRun& run, const std::optional<VariantRun>& variant,
                          const std::optional<Expected>& expected) {
  if (!variant) return "-";
  if (!variant->refused.empty()) return "refused";
  return fmt::format("{} {}, {}{}", name_of(expected->reading),
                     number(*run.scene, *expected, variant->measured), name_of(variant->verdict),
                     variant->broken_by.empty() ? "" : " by " + variant->broken_by);
}

std::string claimed_text(const SceneRun& run, const std::optional<VariantRun>& variant,
                         const std::optional<Expected>& expected) {
  if (!variant || !variant->refused.empty()) return "-";
  return variant->claimed ? number(*run.scene, *expected, *variant->claimed) : "nothing";
}

std::string expected_text(const Scene& scene, const Expected& expected) {
  if (!expected.refusal.empty()) return fmt::format("refused: \"{}\"", expected.refusal);
  const std::string verdict = expected.verdict ? name_of(*expected.verdict) : "any verdict";
  std::string text = verdict;
  if (expected.least > 0.0)
    text += fmt::format(", {} at least {}", name_of(expected.reading),
                        number(scene, expected, expected.least));
  if (std::isfinite(expected.most))
    text += fmt::format(", {} at most {}", name_of(expected.reading),
                        number(scene, expected, expected.most));
  return text;
}

std::string gallery_json(const std::vector<SceneRun>& runs, const std::string& command) {
  Json json{{"schema", "plumb.stability/1"}, {"command", command}};
  json["scenes"] = Json::array();
  bool all = true;
  for (const SceneRun& run : runs) {
    const Scene& scene = *run.scene;
    Json entry{{"name", scene.name},
               {"method", run.method},
               {"fails", scene.fails},
               {"finding", scene.finding},
               {"tolerance", to_text(scene.tolerance)},
               {"parameters", scene.parameters},
               {"camera", camera_json(scene.camera)}};
    if (run.published)
      entry["published"] = variant_json(run, *run.published, *run.expected_published);
    if (run.conservative)
      entry["conservative"] = variant_json(run, *run.conservative, *run.expected_conservative);
    entry["as_expected"] = run.is_as_expected();
    all = all && run.is_as_expected();
    json["scenes"].push_back(std::move(entry));
  }
  json["as_expected"] = all;
  return json.dump(2) + "\n";
}

}  // namespace plumb::audit::stability
