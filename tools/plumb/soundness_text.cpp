#include "soundness_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "text_table.h"

namespace plumb::tool {
namespace {

using audit::soundness::CaseResult;
using audit::soundness::Draws;
using audit::soundness::MethodTightness;
using audit::soundness::Summary;
using audit::soundness::Tally;

std::string percent(std::int64_t part, std::int64_t whole) {
  return fmt::format(
      "{:.1f} %", whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0);
}

std::string tallies_text(const Summary& summary) {
  std::vector<std::vector<std::string>> rows;
  for (const Tally& tally : summary.tallies) {
    std::string heading = tally.heading;
    for (const auto& [name, count] : tally.counts) {
      rows.push_back({heading, name, fmt::format("{}", count), percent(count, summary.draws)});
      heading.clear();
    }
  }
  return text_table({{"draws"}, {""}, {"cases", true}, {"share", true}}, rows);
}

std::string tightness_text(const Summary& summary) {
  std::vector<std::vector<std::string>> rows;
  for (const MethodTightness& row : summary.tightness) {
    std::vector<std::string> cells{row.method, fmt::format("{}", row.cases),
                                   fmt::format("{}", row.measured)};
    for (const double value : {row.least, row.low, row.median, row.high})
      cells.push_back(row.measured > 0 ? fmt::format("{:.4g}", value) : "-");
    rows.push_back(std::move(cells));
  }
  return text_table({{"tightness (claimed / measured)"},
                     {"cases", true},
                     {"measured", true},
                     {"least", true},
                     {"5 %", true},
                     {"median", true},
                     {"95 %", true}},
                    rows);
}

std::string failure_text(const CaseResult& failure) {
  return fmt::format("case {}: {}: {}\n  {}\n", failure.drawn.index,
                     audit::soundness::name_of(failure.outcome.ending), failure.outcome.reason,
                     audit::soundness::audit_command(failure.drawn.scene));
}

}  // namespace

std::string soundness_text(const Summary& summary) {
  std::string text = tallies_text(summary) + "\n" + tightness_text(summary) + "\n";
  for (const CaseResult& failure : summary.failures) text += failure_text(failure);
  if (summary.failures.empty())
    return text + fmt::format("Every conservative claim holds in {} draws.\n", summary.draws);
  return text +
         fmt::format("{} of {} draws are not sound.\n", summary.failures.size(), summary.draws);
}

std::string soundness_json(const Summary& summary, const Draws& draws, const std::string& command) {
  using nlohmann::ordered_json;
  ordered_json json{{"schema", "plumb.soundness/1"},
                    {"command", command},
                    {"seed", draws.seed},
                    {"first", draws.first},
                    {"draws", summary.draws}};
  for (const Tally& tally : summary.tallies) {
    for (const auto& [name, count] : tally.counts)
      json["distribution"][tally.heading][name] = count;
  }
  for (const MethodTightness& row : summary.tightness) {
    ordered_json& method = json["tightness"][row.method];
    method = {{"cases", row.cases}, {"measured", row.measured}};
    if (row.measured == 0) continue;
    method.update(
        {{"least", row.least}, {"p5", row.low}, {"median", row.median}, {"p95", row.high}});
  }
  json["failures"] = ordered_json::array();
  for (const CaseResult& failure : summary.failures)
    json["failures"].push_back({{"case", failure.drawn.index},
                                {"outcome", audit::soundness::name_of(failure.outcome.ending)},
                                {"reason", failure.outcome.reason},
                                {"command", audit::soundness::audit_command(failure.drawn.scene)}});
  return json.dump(2) + "\n";
}

}  // namespace plumb::tool
