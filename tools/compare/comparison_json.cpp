#include "compare/comparison_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/comparison_words.h"

namespace plumb::compare {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "plumb.compare/1";

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }
Json pixel(int x, int y) { return x >= 0 ? Json::array({x, y}) : Json(nullptr); }
Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

template <class Items, class ToJson>
Json list(const Items& items, const ToJson& to_json) {
  Json all = Json::array();
  for (const auto& item : items) all.push_back(to_json(item));
  return all;
}

Json measurement_json(const Measurement& m) {
  return {{"name", m.name()},
          {"group", m.group},
          {"channel", text_or_null(m.channel)},
          {"metric", m.metric},
          {"threshold", number(m.threshold)},
          {"value", number(m.value)},
          {"unit", text_or_null(m.info().unit)},
          {"pixel", pixel(m.x, m.y)}};
}

Json judgement_json(const Judgement& j) {
  Json json{{"limit", j.measured.name()},
            {"sense", j.measured.info().more_is_better ? "at least" : "at most"},
            {"bound", number(j.limit.bound)},
            {"measured", number(j.measured.value)},
            {"unit", text_or_null(j.measured.info().unit)},
            {"holds", j.holds},
            {"use", number(use_of(j))},
            {"pixel", pixel(j.measured.x, j.measured.y)}};
  return json;
}

Json coverage_json(const std::optional<CoverageErrors>& coverage) {
  if (!coverage) return nullptr;
  return {{"must_be_terrain", coverage->must_be_terrain},
          {"must_be_sky", coverage->must_be_sky},
          {"undecided", coverage->undecided},
          {"holes", coverage->holes},
          {"overshoot", coverage->overshoot}};
}

Json mask_json(const std::optional<MaskReport>& mask) {
  if (!mask) return nullptr;
  return {{"masked", mask->masked},
          {"would_differ", mask->would_differ},
          {"would_fail", mask->would_fail}};
}

Json worst_json(const WorstPixel& worst) {
  return {{"pixel", pixel(worst.x, worst.y)}, {"what", worst.what},
          {"value", number(worst.value)},     {"unit", text_or_null(worst.unit)},
          {"reference", worst.reference},     {"candidate", worst.candidate}};
}

void add_comparison(Json& json, const Comparison& c) {
  json["reference"] = c.reference_name;
  json["candidate"] = c.candidate_name;
  json["size_px"] = {c.width_px, c.height_px};
  json["encoding"] = c.encoding;
  json["channels"] = c.channels;
  json["profile"] = c.profile;
  json["verdict"] = name_of(c.verdict);
  json["reasons"] = c.reasons;
  json["judgements"] = list(c.judgements, judgement_json);
  json["not_judged"] = c.not_judged;
  json["measurements"] = list(c.measurements, measurement_json);
  json["systematic"] = list(c.systematic, [](const Diagnosis& found) {
    return Json{{"kind", name_of(found.kind)},
                {"text", found.text},
                {"rms_before", number(found.rms_before)},
                {"rms_after", number(found.rms_after)}};
  });
  json["coverage"] = coverage_json(c.coverage);
  json["not_finite"] = {{"alike", c.numbers.alike},
                        {"unlike", c.numbers.unlike},
                        {"first", text_or_null(c.numbers.first)}};
  json["mask"] = mask_json(c.mask);
  json["worst"] = list(c.worst, worst_json);
  json["notes"] = c.notes;
}

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json pairs_json(const FolderComparison& folders) {
  return list(by_badness(folders), [&](std::size_t at) {
    const FolderPair& pair = folders.pairs[at];
    Json json{{"name", pair.name}, {"page", text_or_null(pair.page)}};
    json["comparison"] = {{"schema", kSchema}};
    add_comparison(json["comparison"], pair.comparison);
    return json;
  });
}

}  // namespace

std::string comparison_json(const Comparison& comparison, const std::string& command) {
  Json json{{"schema", kSchema}, {"command", command}};
  add_comparison(json, comparison);
  return dumped(json);
}

std::string folder_json(const FolderComparison& folders, const std::string& command) {
  Json json{{"schema", "plumb.compare-folder/1"},  {"command", command},
            {"reference", folders.reference_name}, {"candidate", folders.candidate_name},
            {"profile", folders.profile},          {"verdict", name_of(folders.verdict())}};
  json["counts"] = {{"pairs", folders.pairs.size()},
                    {"fail", folders.count(CompareVerdict::Fails)},
                    {"none", folders.count(CompareVerdict::None)},
                    {"pass", folders.count(CompareVerdict::Passes)},
                    {"equal", folders.count(CompareVerdict::Equal)},
                    {"missing", folders.missing.size()},
                    {"errors", folders.errors.size()}};
  json["missing"] = list(folders.missing, [](const MissingFile& file) {
    return Json{{"name", file.name}, {"missing_in", file.in_reference ? "candidate" : "reference"}};
  });
  json["errors"] = list(folders.errors, [](const FolderError& error) {
    return Json{{"name", error.name}, {"message", error.message}};
  });
  json["pairs"] = pairs_json(folders);
  return dumped(json);
}

}  // namespace plumb::compare
