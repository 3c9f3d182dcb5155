// Golden cases for programs and test servers.
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/comparison_json.h"
#include "golden_text.h"
#include "report/junit.h"

namespace plumb::tool {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// An id or a level, which are whole.
Json whole(float value) {
  return std::abs(value) < 1e9f && value == std::floor(value)
             ? Json(static_cast<std::int64_t>(value))
             : number(value);
}

Json patch_json(const std::optional<PatchAt>& patch) {
  if (!patch || !(patch->id >= 0.0f)) return nullptr;
  Json json{{"id", whole(patch->id)}};
  if (patch->lod) json["lod"] = whole(*patch->lod);
  return json;
}

Json channel_json(const ChannelDifference& channel) {
  Json json{{"channel", channel.channel},
            {"pixels", channel.pixels},
            {"largest", number(channel.largest)}};
  if (channel.x < 0) return json;
  json["pixel"] = {channel.x, channel.y};
  json["golden"] = number(channel.reference);
  json["now"] = number(channel.picture);
  return json;
}

Json patches_json(const GoldenCheck& check) {
  Json list = Json::array();
  for (std::size_t k = 0; k < check.patches_golden.size(); ++k) {
    const compare::WorstPixel& worst = check.comparison->worst[k];
    list.push_back({{"pixel", {worst.x, worst.y}},
                    {"golden", patch_json(check.patches_golden[k])},
                    {"now", patch_json(check.patches_now[k])}});
  }
  return list;
}

void add_metrics(const GoldenCheck& check, Json& entry) {
  for (const ChannelDifference& channel : check.channels)
    entry["channels"].push_back(channel_json(channel));
  if (check.comparison) {
    entry["comparison"] = Json::parse(compare::comparison_json(*check.comparison, ""));
    entry["comparison"].erase("command");
    if (!check.patches_golden.empty() && (check.patches_golden[0] || check.patches_now[0]))
      entry["patches"] = patches_json(check);
  }
  if (check.responsible) {
    entry["patch_responsible"] = patch_json(check.responsible->patch);
    entry["patch_responsible"]["pixels"] = check.responsible->pixels;
    entry["patch_responsible"]["of"] = check.responsible->of;
  }
}

Json case_json(const GoldenOptions& options, const GoldenCheck& check) {
  Json entry{{"name", check.name},
             {"verdict", name_of(check.verdict)},
             {"tolerance", check.tolerance},
             {"expected", checksum_digits(check.expected)}};
  if (check.found != 0) entry["found"] = checksum_digits(check.found);
  if (!check.message.empty()) entry["message"] = check.message;
  if (check.verdict == GoldenVerdict::Same) return entry;
  add_metrics(check, entry);
  const auto file = [&](const char* what, const std::filesystem::path& path) {
    if (!path.empty()) entry["files"][what] = path.string();
  };
  file("golden", check.files.golden);
  file("actual", check.files.actual);
  file("difference", check.files.difference);
  file("report", check.files.page);
  const NextSteps steps = next_steps(options, check);
  if (!steps.see.empty()) entry["to_see"] = steps.see;
  if (!steps.accept.empty()) entry["to_accept"] = steps.accept;
  return entry;
}

}  // namespace

std::string check_json(const GoldenOptions& options, const std::vector<GoldenCheck>& checks,
                       const std::vector<std::string>& strays, const std::string& command) {
  Json json{{"schema", "plumb.golden/1"}, {"command", command}};
  json["cases"] = Json::array();
  for (const GoldenCheck& check : checks) json["cases"].push_back(case_json(options, check));
  json["strays"] = strays;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string check_junit(const GoldenOptions& options, const std::vector<GoldenCheck>& checks,
                        const std::vector<std::string>& strays) {
  report::JUnitSuite suite{"plumb golden", {}};
  for (const GoldenCheck& check : checks) {
    report::JUnitCase judged{"plumb.golden", check.name};
    if (check.verdict == GoldenVerdict::Failed) {
      judged.error = check.message;
    } else if (!check.passes()) {
      judged.failure = {std::string(name_of(check.verdict)) + ": " + check.message,
                        case_text(options, check)};
    }
    suite.cases.push_back(judged);
  }
  for (const std::string& stray : strays)
    suite.cases.push_back({"plumb.golden", stray, {}, "no case names the file"});
  return report::to_junit_xml(suite);
}

}  // namespace plumb::tool
