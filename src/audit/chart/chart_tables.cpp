#include "audit/chart/chart_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "audit/chart/broken_claims.h"
#include "audit/chart/winners.h"

namespace plumb::audit::chart {
namespace {

// Not the column of a table.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string row_of(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + escaped(cell) + " |";
  return row + "\n";
}

std::string heading_of(const std::vector<std::string>& cells) {
  std::string row = row_of(cells) + "|";
  for (std::size_t k = 0; k < cells.size(); ++k) row += " --- |";
  return row + "\n";
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "∞";
}

std::string worst_text(const RunTable& table, const BrokenClaims& claims) {
  if (claims.worst_run < 0) return "-";
  const Run& run = table.runs[static_cast<std::size_t>(claims.worst_run)];
  const ClaimedAndMeasured& claim = run.claims[static_cast<std::size_t>(claims.worst_claim)];
  return fmt::format("{} × ({}: {} {} where {} was claimed, {})", number_text(claims.worst_ratio),
                     claim.measure, number_text(claim.measured), claim.unit,
                     number_text(claim.claimed),
                     table.cameras[static_cast<std::size_t>(run.camera)]);
}

std::string claims_table(const RunTable& table) {
  std::string text =
      heading_of({"terrain", "method", "judged", "broken", "by an error", "the worst by an error",
                  "by coverage", "wrong pixels at most", "by patches"});
  for (const BrokenClaims& claims : broken_claims(table)) {
    text += row_of({table.terrains[static_cast<std::size_t>(claims.terrain)].name,
                    table.series[static_cast<std::size_t>(claims.series)].name,
                    fmt::to_string(claims.judged), fmt::to_string(claims.broken),
                    fmt::to_string(claims.by_error), worst_text(table, claims),
                    fmt::to_string(claims.by_coverage), fmt::format("{:.0f}", claims.most_pixels),
                    fmt::to_string(claims.by_patches)});
  }
  return text;
}

std::string cost_of(const std::vector<Cheapest>& all, int kind, int series, double limit_px) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const Cheapest& one) {
    return one.kind == kind && one.series == series && one.limit_px == limit_px;
  });
  return at == all.end() ? "-" : fmt::format("{} ({})", number_text(at->cost), at->tolerance);
}

std::string cost_table(const RunTable& table, std::size_t cost) {
  const std::vector<Cheapest> all = cheapest_of(table, cost);
  const std::vector<std::string> kinds = kinds_of(table);
  std::vector<std::string> heading{"kind", "method"};
  for (const double limit : kErrorLimits) heading.push_back(fmt::format("{} px", limit));
  std::string text = heading_of(heading);
  std::set<std::pair<int, int>> there;
  for (const Cheapest& one : all) there.emplace(one.kind, one.series);
  for (const auto& [kind, series] : there) {
    std::vector<std::string> cells{kinds[static_cast<std::size_t>(kind)],
                                   table.series[static_cast<std::size_t>(series)].name};
    for (const double limit : kErrorLimits) cells.push_back(cost_of(all, kind, series, limit));
    text += row_of(cells);
  }
  return text;
}

}  // namespace

std::string chart_tables(const RunTable& table, std::size_t cost, const std::string& command) {
  const bool shared =
      std::any_of(table.runs.begin(), table.runs.end(), [](const Run& run) { return run.shared; });
  std::string text = fmt::format(
      "# What the charts show, in numbers\n\nMade by `{}` of {} runs.\n\n## Claims\nRuns with a "
      "verdict, those that broke a claim, and how: by an error beyond what was claimed, by wrong "
      "pixels where none were claimed, by patches that break a claim of their own.\n\n",
      command, table.runs.size());
  text += claims_table(table);
  text += fmt::format(
      "\n## The cost of an error\n{}: median over the views, of the cheapest tolerance (in "
      "brackets, as asked) at which the measured error stays within the column's in every view and "
      "no "
      "pixel is wrong. \"-\": no tolerance of the sweep keeps it.{}\n\n",
      kCosts[cost].name,
      kCosts[cost].is_time && shared ? " Other runs used the machine meanwhile." : "");
  return text + cost_table(table, cost);
}

}  // namespace plumb::audit::chart
