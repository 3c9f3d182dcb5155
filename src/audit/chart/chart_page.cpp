#include "audit/chart/chart_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "audit/chart/chart_data.h"
#include "audit/chart/plain_charts.h"
#include "report/html_page.h"
#include "report/web_assets.h"

namespace plumb::audit::chart {
namespace {

constexpr std::size_t kMostListed = 200;

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string summary(const RunTable& table) {
  return fmt::format(
      "{} over {} by {} are charted; {} failed and {} were skipped (listed at the end).",
      counted(table.runs.size(), "finished run", "finished runs"),
      counted(table.terrains.size(), "terrain", "terrains"),
      counted(table.series.size(), "method or variant", "methods and variants"),
      table.failed.size(), table.skipped.size());
}

// Reasons with their counts, then the runs themselves.
void add_unfinished(report::HtmlPage& page, const char* caption,
                    const std::vector<Unfinished>& runs) {
  if (runs.empty()) return;
  std::map<std::string, std::size_t> reasons;
  for (const Unfinished& run : runs) ++reasons[run.error];
  report::Table counts{fmt::format("{} runs {}", runs.size(), caption),
                       {{"reason", false, true}, {"runs", true}},
                       {}};
  for (const auto& [reason, count] : reasons)
    counts.rows.push_back({{reason, std::to_string(count)}});
  page.add_table(counts);
  const std::size_t listed = std::min(runs.size(), kMostListed);
  report::Table table{
      listed < runs.size() ? fmt::format("The first {} of them", listed) : "Which they are",
      {{"run", false, true}, {"reason", false, true}},
      {},
      true};
  for (std::size_t k = 0; k < listed; ++k) table.rows.push_back({{runs[k].what, runs[k].error}});
  page.add_table(table);
}

std::vector<report::KeyValue> origin(const PageInput& input) {
  std::vector<report::KeyValue> entries{{"results", input.results},
                                        {"measured by plumb", input.table.program},
                                        {"made again by", input.command}};
  if (input.table.torn)
    entries.push_back({"left out", "the last line, which ends within itself: a run in flight"});
  if (input.table.repeated > 0)
    entries.push_back({"left out", fmt::format("{} lines of runs that stood there before",
                                               input.table.repeated)});
  return entries;
}

std::string templates_json() {
  std::string json = "{";
  for (const ChartWords& chart : charts())
    json += fmt::format("{}\"{}\":{}", json.size() > 1 ? "," : "", chart.name,
                        report::chart_template(chart.name));
  return json + "}";
}

}  // namespace

const std::vector<ChartWords>& charts() {
  static const std::vector<ChartWords> kCharts{
      {"cost-error", "What does accuracy cost?",
       "Each small point is one run: one picture of one terrain. A large marker is the median over "
       "all views of one terrain at one tolerance, and a curve joins a method's tolerances. Lower "
       "left is best: less error for less work. The broad grey steps are the Pareto front: no "
       "method, shown or hidden, has a median with both less error and less cost. Both axes are "
       "logarithmic; 0 and \xE2\x88\x9E have shaded places of their own."}};
  return kCharts;
}

std::string plain_chart(const std::string& name, const RunTable& table,
                        const std::vector<Setting>& settings) {
  const std::size_t cost = first_cost(table);
  if (name == "cost-error") return plain_cost_chart(table, settings, cost);
  return "";
}

std::string chart_page(const PageInput& input) {
  report::HtmlPage page("Speed against accuracy");
  page.add_paragraph(summary(input.table));
  if (!input.library.empty()) {
    page.add_paragraph(
        "Rest on a point to see what it is, click it to keep that and to copy its command.");
    page.set_live_charts(
        {chart_data(input.table, input.settings), templates_json(), input.library});
  }
  for (const ChartWords& chart : charts()) {
    page.add_heading(chart.title);
    page.add_paragraph(chart.words);
    if (!input.library.empty()) {
      page.add_live_chart(chart.name, chart.title);
      continue;
    }
    const std::string svg = plain_chart(chart.name, input.table, input.settings);
    if (!svg.empty()) page.add_chart(chart.title, svg);
  }
  page.add_heading("What is not in the charts");
  if (input.table.failed.empty() && input.table.skipped.empty())
    page.add_paragraph("No run failed, none was skipped.");
  add_unfinished(page, "failed", input.table.failed);
  add_unfinished(page, "were skipped", input.table.skipped);
  page.add_key_values("Where this comes from", origin(input));
  return page.text();
}

std::string print_job(const RunTable& table, const std::vector<Setting>& settings) {
  std::string json = fmt::format("{{\"table\":{},\"charts\":[", chart_data(table, settings));
  bool first = true;
  for (const ChartWords& chart : charts()) {
    json += fmt::format("{}{{\"template\":{},\"state\":{{}},\"svg\":\"{}.svg\"}}", first ? "" : ",",
                        report::chart_template(chart.name), chart.name);
    first = false;
  }
  return json + "]}\n";
}

}  // namespace plumb::audit::chart
