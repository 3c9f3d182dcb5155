#include "audit/chart/chart_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "audit/chart/camera_paths.h"
#include "audit/chart/scales.h"
#include "audit/chart/winners.h"

namespace plumb::audit::chart {
namespace {

using Json = nlohmann::ordered_json;

Json number(std::optional<double> value) {
  if (!value || std::isnan(*value)) return nullptr;
  if (std::isinf(*value)) return "inf";
  const double rounded = std::strtod(fmt::format("{:.6g}", *value).c_str(), nullptr);
  if (rounded == std::floor(rounded) && std::abs(rounded) < 1e15)
    return static_cast<std::int64_t>(rounded);
  return rounded;
}

Json axis_json(const report::OpenAxis& axis) {
  Json ticks = Json::array(), texts = Json::array();
  for (const report::OpenTick& tick : axis.ticks) {
    ticks.push_back(number(tick.at));
    texts.push_back(tick.text);
  }
  return {{"low", number(axis.low)},
          {"high", number(axis.high)},
          {"first", number(axis.first)},
          {"last", number(axis.last)},
          {"zero", number(axis.zero_at)},
          {"infinite", number(axis.infinite_at)},
          {"ticks", ticks},
          {"texts", texts}};
}

Json series_json(const RunTable& table) {
  Json list = Json::array();
  const std::vector<SeriesLook> looks = looks_of(table);
  for (std::size_t k = 0; k < table.series.size(); ++k) {
    const Series& s = table.series[k];
    list.push_back({{"name", s.name},
                    {"method", s.method},
                    {"variant", s.variant},
                    {"parameters", s.parameters},
                    {"unit", s.unit},
                    {"colour", looks[k].colour},
                    {"shape", looks[k].shape},
                    {"dash", looks[k].dash},
                    {"filled", looks[k].filled}});
  }
  return list;
}

// Words of all commands once, and each command as their numbers.
class Words {
 public:
  Json numbers(const std::string& text) {
    Json list = Json::array();
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(' ', begin), text.size());
      const std::string word = text.substr(begin, end - begin);
      const auto [at, is_new] = rows_.try_emplace(word, rows_.size());
      if (is_new) words_.push_back(word);
      list.push_back(at->second);
      begin = end + 1;
    }
    return list;
  }
  const Json& words() const { return words_; }

 private:
  std::map<std::string, std::size_t> rows_;
  Json words_ = Json::array();
};

Json runs_json(const RunTable& table, Words& words) {
  Json columns;
  const auto column = [&](const char* name, auto value_of) {
    Json values = Json::array();
    for (const Run& run : table.runs) values.push_back(value_of(run));
    columns[name] = std::move(values);
  };
  column("terrain", [](const Run& r) { return r.terrain; });
  column("series", [](const Run& r) { return r.series; });
  column("camera", [](const Run& r) { return r.camera; });
  column("frame", [](const Run& r) { return r.frame; });
  column("path", [](const Run& r) { return r.on_path ? 1 : 0; });
  column("tolerance", [](const Run& r) { return number(r.tolerance); });
  column("error", [](const Run& r) { return number(r.error_px); });
  column("popping", [](const Run& r) { return number(r.popping_px); });
  column("shared", [](const Run& r) { return r.shared ? 1 : 0; });
  column("verdict", [](const Run& r) { return r.verdict; });
  for (const std::size_t cost : costs_there(table))
    column(kCosts[cost].key, [cost](const Run& r) { return number(r.costs[cost]); });
  column("command", [&](const Run& r) { return words.numbers(r.command); });
  return columns;
}

Json settings_json(const RunTable& table, const std::vector<Setting>& settings) {
  Json columns;
  const auto column = [&](const char* name, auto value_of) {
    Json values = Json::array();
    for (const Setting& setting : settings) values.push_back(value_of(setting));
    columns[name] = std::move(values);
  };
  column("terrain", [](const Setting& s) { return s.terrain; });
  column("series", [](const Setting& s) { return s.series; });
  column("tolerance", [](const Setting& s) { return number(s.tolerance); });
  column("runs", [](const Setting& s) { return s.runs; });
  column("error", [](const Setting& s) { return number(s.error_px); });
  column("shared", [](const Setting& s) { return s.shared ? 1 : 0; });
  const std::vector<std::size_t> there = costs_there(table);
  for (const std::size_t cost : there)
    column(kCosts[cost].key, [cost](const Setting& s) { return number(s.costs[cost]); });
  column("front", [&](const Setting& s) {
    Json keys = Json::array();
    for (const std::size_t cost : there)
      if (s.on_front[cost]) keys.push_back(kCosts[cost].key);
    return keys;
  });
  return columns;
}

Json claims_json(const RunTable& table, const std::vector<ClaimMeasure>& measures) {
  Json run = Json::array(), measure = Json::array(), claimed = Json::array(),
       measured = Json::array(), holds = Json::array();
  for (std::size_t k = 0; k < table.runs.size(); ++k) {
    for (const ClaimedAndMeasured& claim : table.runs[k].claims) {
      const auto at = std::find_if(measures.begin(), measures.end(), [&](const ClaimMeasure& m) {
        return m.name == claim.measure && m.unit == claim.unit;
      });
      run.push_back(k);
      measure.push_back(at - measures.begin());
      claimed.push_back(number(claim.claimed));
      measured.push_back(number(claim.measured));
      holds.push_back(claim.holds ? 1 : 0);
    }
  }
  return {{"run", run},
          {"measure", measure},
          {"claimed", claimed},
          {"measured", measured},
          {"holds", holds}};
}

Json winners_json(const RunTable& table) {
  Json rows = Json::array();
  for (const std::size_t cost : costs_there(table)) {
    for (const Winner& w : winners_of(table, cost))
      rows.push_back({{"cost", kCosts[cost].key},
                      {"kind", w.kind},
                      {"limit", number(w.limit_px)},
                      {"series", w.series},
                      {"tolerance", number(w.tolerance)},
                      {"value", number(w.cost)},
                      {"second", w.second},
                      {"times", number(w.times_cheaper)}});
  }
  return rows;
}

Json costs_json(const RunTable& table) {
  Json list = Json::array();
  for (const std::size_t cost : costs_there(table))
    list.push_back({{"key", kCosts[cost].key},
                    {"name", kCosts[cost].name},
                    {"unit", kCosts[cost].unit},
                    {"time", kCosts[cost].is_time},
                    {"axis", axis_json(cost_axis(table, cost))}});
  return list;
}

Json measures_json(const std::vector<ClaimMeasure>& measures) {
  Json list = Json::array();
  for (const ClaimMeasure& measure : measures)
    list.push_back(
        {{"name", measure.name}, {"unit", measure.unit}, {"axis", axis_json(measure.axis)}});
  return list;
}

Json paths_json(const RunTable& table) {
  Json list = Json::array();
  for (const CameraPath& path : paths_of(table))
    list.push_back({{"terrain", path.terrain},
                    {"camera", path.camera},
                    {"title", path.title},
                    {"axis", axis_json(path.frames)}});
  return list;
}

Json asked_json(const std::vector<Asked>& all) {
  Json list = Json::array();
  for (const Asked& asked : all)
    list.push_back({{"value", number(asked.value)}, {"unit", asked.unit}});
  return list;
}

}  // namespace

std::string chart_data(const RunTable& table, const std::vector<Setting>& settings,
                       std::size_t cost) {
  const std::vector<ClaimMeasure> measures = claim_measures(table);
  Json terrains = Json::array();
  for (const Terrain& terrain : table.terrains)
    terrains.push_back({{"name", terrain.name}, {"kind", terrain.kind}});
  Words words;
  Json data{{"cost", kCosts[cost].key},
            {"costs", costs_json(table)},
            {"error", axis_json(error_axis(table))},
            {"popping", axis_json(popping_axis(table))},
            {"series", series_json(table)},
            {"terrains", terrains},
            {"kinds", kinds_of(table)},
            {"limits", kErrorLimits},
            {"cameras", table.cameras},
            {"measures", measures_json(measures)},
            {"paths", paths_json(table)},
            {"asked", asked_json(asked_on_paths(table))},
            {"first_asked", first_asked(asked_on_paths(table))},
            {"runs", runs_json(table, words)},
            {"settings", settings_json(table, settings)},
            {"claims", claims_json(table, measures)},
            {"winners", winners_json(table)}};
  data["words"] = words.words();
  return data.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace plumb::audit::chart
