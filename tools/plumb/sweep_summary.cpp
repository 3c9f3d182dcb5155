#include "sweep_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace plumb::tool {

SweepSummary summary_of(const std::vector<audit::sweep::ResultLine>& lines) {
  SweepSummary summary;
  for (const audit::sweep::ResultLine& line : lines) {
    if (line.status == "done") {
      ++summary.done;
      summary.broken += line.verdict == "broken" ? 1 : 0;
      continue;
    }
    ++(line.status == "failed" ? summary.failed : summary.skipped);
    const auto found = std::find_if(
        summary.reasons.begin(), summary.reasons.end(),
        [&](const SweepReason& r) { return r.status == line.status && r.error == line.error; });
    if (found != summary.reasons.end()) {
      ++found->runs;
    } else {
      summary.reasons.push_back({line.status, line.error, 1, line.run});
    }
  }
  std::stable_partition(summary.reasons.begin(), summary.reasons.end(),
                        [](const SweepReason& reason) { return reason.status == "failed"; });
  return summary;
}

std::string summary_text(const SweepSummary& summary) {
  const std::size_t runs = summary.done + summary.failed + summary.skipped;
  std::string text = fmt::format("{} run{}: {} done", runs, runs == 1 ? "" : "s", summary.done);
  if (summary.broken > 0) text += fmt::format(" ({} broke a claim)", summary.broken);
  if (summary.failed > 0) text += fmt::format(", {} failed", summary.failed);
  if (summary.skipped > 0) text += fmt::format(", {} skipped", summary.skipped);
  text += "\n";
  for (const SweepReason& reason : summary.reasons)
    text += fmt::format("  {} {}: {} (the first: {})\n", reason.status, reason.runs, reason.error,
                        reason.first);
  return text;
}

std::string summary_json(const SweepSummary& summary, const std::string& schema,
                         const std::string& command, const std::string& file) {
  nlohmann::ordered_json json{{"schema", schema},
                              {"command", command},
                              {"file", file},
                              {"runs", summary.done + summary.failed + summary.skipped},
                              {"done", summary.done},
                              {"broken", summary.broken},
                              {"failed", summary.failed},
                              {"skipped", summary.skipped}};
  json["reasons"] = nlohmann::ordered_json::array();
  for (const SweepReason& reason : summary.reasons)
    json["reasons"].push_back({{"status", reason.status},
                               {"error", reason.error},
                               {"runs", reason.runs},
                               {"first", reason.first}});
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace plumb::tool
