#include "detection_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "text_table.h"

namespace plumb::tool {
namespace {

using Json = nlohmann::ordered_json;
using compare::DetectionRow;

std::string limits_text(const compare::Calibration& calibration) {
  std::vector<std::vector<std::string>> rows;
  for (const compare::CalibratedLimit& each : calibration.limits) {
    const compare::Measurement about{each.limit.group, each.limit.channel, each.limit.metric,
                                     each.limit.threshold};
    rows.push_back({about.name(), fmt::format("{:.4g}", each.limit.bound),
                    fmt::format("{:.4g}", each.reached), fmt::format("{:.4g}", each.built_in),
                    each.worst_pair});
  }
  return text_table({{"limit"}, {"proposed", true}, {"reached", true}, {"was", true}, {"by"}},
                    rows);
}

std::string rate_text(int failed, int pictures) {
  return pictures > 0 ? fmt::format("{:.0f} %", 100.0 * failed / pictures) : "-";
}

std::string table_text(const NamedTable& named) {
  std::vector<TextColumn> columns{
      {"planted"}, {"should"}, {"pictures", true}, {"failed", true}, {""}};
  for (const std::string& other : named.table.others) columns.push_back({other, true});
  columns.push_back({"caught by"});
  std::vector<std::vector<std::string>> rows;
  for (const DetectionRow& row : named.table.rows) {
    std::vector<std::string> cells{row.kind->name, row.kind->harmless ? "pass" : "fail",
                                   std::to_string(row.pictures),
                                   rate_text(row.failed, row.pictures),
                                   row.pictures == 0 ? "needs a scene"
                                   : row.as_wanted() ? ""
                                                     : "!"};
    for (const int failed : row.failed_by_others) cells.push_back(rate_text(failed, row.pictures));
    cells.push_back(fmt::format("{}", fmt::join(row.best_checks(2), ", ")));
    rows.push_back(std::move(cells));
  }
  std::string text = fmt::format("\n{}\n{}", named.name, text_table(columns, rows));
  for (const DetectionRow& row : named.table.rows) {
    constexpr std::size_t kMost = 5;
    for (std::size_t k = 0; k < std::min(kMost, row.wrong.size()); ++k)
      text += fmt::format("! {} {}: {}\n", row.kind->name, row.kind->harmless ? "failed" : "passed",
                          row.wrong[k]);
  }
  return text;
}

Json table_json(const NamedTable& named) {
  Json json{{"name", named.name}, {"rows", Json::array()}};
  for (const DetectionRow& row : named.table.rows) {
    Json entry{{"planted", row.kind->name},      {"meaning", row.kind->meaning},
               {"harmless", row.kind->harmless}, {"pictures", row.pictures},
               {"failed", row.failed},           {"as_wanted", row.as_wanted()},
               {"caught_by", row.caught_by},     {"wrong", row.wrong}};
    for (std::size_t k = 0; k < row.failed_by_others.size(); ++k)
      entry["failed_by_others"][named.table.others[k]] = row.failed_by_others[k];
    json["rows"].push_back(std::move(entry));
  }
  return json;
}

Json calibration_json(const compare::Calibration& calibration) {
  Json json{{"pairs", calibration.pairs},
            {"cannot_pass", calibration.hopeless},
            {"limits", Json::array()}};
  for (const compare::CalibratedLimit& each : calibration.limits) {
    const compare::Measurement about{each.limit.group, each.limit.channel, each.limit.metric,
                                     each.limit.threshold};
    const auto number = [](double value) {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    };
    json["limits"].push_back({{"name", about.name()},
                              {"proposed", each.limit.bound},
                              {"reached", number(each.reached)},
                              {"was", each.built_in},
                              {"by", each.worst_pair}});
  }
  json["profile_toml"] = compare::to_toml(calibration.proposed);
  return json;
}

}  // namespace

bool DetectionOutcome::good() const {
  return (!calibration || calibration->hopeless.empty()) &&
         std::all_of(tables.begin(), tables.end(),
                     [](const NamedTable& each) { return each.table.as_wanted(); });
}

std::string detection_text(const DetectionOutcome& outcome) {
  std::string text;
  if (outcome.calibration) {
    for (const std::string& each : outcome.calibration->hopeless)
      text += fmt::format("no limit can pass {}\n", each);
    text += limits_text(*outcome.calibration);
  }
  for (const NamedTable& named : outcome.tables) text += table_text(named);
  const bool all_planted =
      std::all_of(outcome.tables.begin(), outcome.tables.end(), [](const NamedTable& named) {
        return std::all_of(named.table.rows.begin(), named.table.rows.end(),
                           [](const DetectionRow& row) { return row.pictures > 0; });
      });
  return text + (outcome.good() ? all_planted
                                      ? "\nEvery defect is caught, and nothing harmless.\n"
                                      : "\nEvery defect that was planted is caught, and nothing "
                                        "harmless.\n"
                                : "\nNot as it should be where marked with !\n");
}

std::string detection_json(const DetectionOutcome& outcome, const std::string& command_line) {
  Json json{{"schema", outcome.calibration ? "plumb.calibration/1" : "plumb.detection/1"},
            {"command", command_line}};
  if (outcome.calibration) json.update(calibration_json(*outcome.calibration));
  for (const NamedTable& named : outcome.tables) json["detection"].push_back(table_json(named));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace plumb::tool
